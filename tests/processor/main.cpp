// SPDX-License-Identifier: Apache-2.0
//
// A program that consists of the start-up check for a list of features. On a processor that lacks one of them, it must exit before main
// (see tests/cli/processor_test.cpp).
#include <cstdio>

int main() { std::puts("main was reached"); }
