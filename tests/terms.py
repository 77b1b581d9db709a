# SPDX-License-Identifier: BSL-1.0
"""Everyday words, as regular expressions, and the terms of the field to write instead: see docs/glossary.md."""

TERMS = {"answer(s|ed|ing)?": "response, stress or result", "ask(s|ed|ing)?": "evaluate or require", "(tell|say)(s|ing)?|told|said": "report or return",
         "refus(e|ed|es|al|als|ing)": "reject", "(go|goes|going) on": "resume or continue", "hangs? on": "depend on",
         "starv(e|ed|es|ing)": "lose contact stress", "mend(s|ed|ing)?": "fix", "remember(s|ed|ing)?": "store or memory",
         "(hear|feel)(s|ing)?|heard|felt": "the quantity and the verb of the equation", "complain(s|ed|t|ts|ing)?": "reject or message",
         "hopeless": "the bound that is exceeded", "sticking": "tied", "foot wall": "footwall"}
