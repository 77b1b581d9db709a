// SPDX-License-Identifier: BSL-1.0
#include <layers.hpp>

int main() { return layers::stands_on_scarp() ? 0 : 1; }
