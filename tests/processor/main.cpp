// SPDX-License-Identifier: Apache-2.0
//
// A program that is said to need what no processor has together: it must end before main (tests/cli/processor_test.cpp).
#include <cstdio>

int main() { std::puts("main was reached"); }
