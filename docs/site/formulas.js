// SPDX-License-Identifier: BSL-1.0
// Formulas of the pages, which pymdownx.arithmatex has put between \( and \) or \[ and \].
renderMathInElement(document.body);
