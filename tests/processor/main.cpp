// SPDX-License-Identifier: Apache-2.0
//
// A program that requires a combination of features that no processor has. It must exit before main (see tests/cli/processor_test.cpp).
#include <cstdio>

int main() { std::puts("main was reached"); }
