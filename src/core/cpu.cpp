// SPDX-License-Identifier: Apache-2.0
//
// Compares CPUID with the feature macros that the compiler defined for HALFSPACE_ARCH. cmake/arch.cmake passes those macros
// as one string, without the extensions that our code cannot contain. This file is compiled for baseline x86-64. CPUID is
// queried directly: __builtin_cpu_supports in clang 14 has no names for F16C, LZCNT and MOVBE, and /proc/cpuinfo omits what
// the kernel hides and is not the processor's in an emulator.
//
// Feature bits: Intel SDM volume 2A, CPUID; AMD APM volume 3, appendix E. Register state: SDM volume 1, section 13.3 (XCR0).
#include "halfspace/core/cpu.h"

#include <cpuid.h>
#include <string.h>

namespace halfspace {

namespace {

enum class Register : unsigned char { eax, ebx, ecx, edx };

struct Feature {
  const char* macro;  // macro name without underscores: AVX2 for __AVX2__
  const char* name;   // display name; a leading "512" puts it in the list "AVX-512 (...)"
  unsigned leaf, subleaf;
  Register where;
  unsigned bit;
  unsigned state;  // XCR0 bits that the operating system must enable
};

constexpr unsigned kYmm = 0x06;
constexpr unsigned kZmm = 0xe6;

constexpr Feature kFeatures[] = {
    {"SSE3", "SSE3", 1, 0, Register::ecx, 0, 0},
    {"SSSE3", "SSSE3", 1, 0, Register::ecx, 9, 0},
    {"SSE4_1", "SSE4.1", 1, 0, Register::ecx, 19, 0},
    {"SSE4_2", "SSE4.2", 1, 0, Register::ecx, 20, 0},
    {"POPCNT", "POPCNT", 1, 0, Register::ecx, 23, 0},
    {"MOVBE", "MOVBE", 1, 0, Register::ecx, 22, 0},
    {"LZCNT", "LZCNT", 0x80000001, 0, Register::ecx, 5, 0},
    {"BMI", "BMI1", 7, 0, Register::ebx, 3, 0},
    {"BMI2", "BMI2", 7, 0, Register::ebx, 8, 0},
    {"AVX", "AVX", 1, 0, Register::ecx, 28, kYmm},
    {"F16C", "F16C", 1, 0, Register::ecx, 29, kYmm},
    {"FMA", "FMA", 1, 0, Register::ecx, 12, kYmm},
    {"AVX2", "AVX2", 7, 0, Register::ebx, 5, kYmm},
    {"FMA4", "FMA4", 0x80000001, 0, Register::ecx, 16, kYmm},
    {"XOP", "XOP", 0x80000001, 0, Register::ecx, 11, kYmm},
    {"TBM", "TBM", 0x80000001, 0, Register::ecx, 21, 0},
    {"AVX512F", "512F", 7, 0, Register::ebx, 16, kZmm},
    {"AVX512BW", "512BW", 7, 0, Register::ebx, 30, kZmm},
    {"AVX512DQ", "512DQ", 7, 0, Register::ebx, 17, kZmm},
    {"AVX512VL", "512VL", 7, 0, Register::ebx, 31, kZmm},
    {"AVX512CD", "512CD", 7, 0, Register::ebx, 28, kZmm},
};

#ifndef HALFSPACE_PORTABLE
// Features required by builds for x86-64-v2 and x86-64-v3 (cmake/arch.cmake), used to name a build that would run on this processor.
constexpr char kLevel2[] = " SSE3 SSSE3 SSE4_1 SSE4_2 POPCNT ";
constexpr char kLevel3[] = " SSE3 SSSE3 SSE4_1 SSE4_2 POPCNT AVX AVX2 BMI BMI2 F16C FMA ";
#endif

// Returns the low half of XCR0, the register state that the operating system saves; 0 if XGETBV is unavailable.
unsigned saved_state() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (__get_cpuid(1, &a, &b, &c, &d) == 0 || (c >> 27 & 1u) == 0) return 0;
  unsigned low = 0, high = 0;
  __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return low;
}

bool has(const Feature& f, unsigned state) {
  unsigned r[4] = {};
  if (__get_cpuid_count(f.leaf, f.subleaf, &r[0], &r[1], &r[2], &r[3]) == 0) return false;
  return (r[static_cast<unsigned>(f.where)] >> f.bit & 1u) != 0 && (state & f.state) == f.state;
}

// Returns whether the text starts with the word and a space.
constexpr bool starts_with(const char* text, const char* word) {
  for (; *word != '\0'; ++word, ++text) {
    if (*text != *word) return false;
  }
  return *text == ' ';
}

// Returns whether the list " A B C " contains the word.
constexpr bool lists(const char* list, const char* word) {
  for (; *list != '\0'; ++list) {
    if (*list == ' ' && starts_with(list + 1, word)) return true;
  }
  return false;
}

// Returns whether kFeatures has all words of the list " A B C ".
constexpr bool knows(const char* list) {
  for (; list[0] != '\0' && list[1] != '\0'; ++list) {
    bool known = *list != ' ';
    for (const Feature& f : kFeatures) known = known || starts_with(list + 1, f.macro);
    if (!known) return false;
  }
  return true;
}
static_assert(knows(HALFSPACE_NEEDS), "kFeatures lacks an extension that cmake/arch.cmake lists");

bool runs(const char* list, unsigned state) {
  for (const Feature& f : kFeatures) {
    if (lists(list, f.macro) && !has(f, state)) return false;
  }
  return true;
}

// A growing line of text. Text that does not fit is cut off.
struct Line {
  char text[768];
  size_t size;
  void add(const char* s) {
    for (; *s != '\0' && size + 1 < sizeof text; ++s) text[size++] = *s;
    text[size] = '\0';
  }
};

// Appends the missing features of one kind, separated by commas, and returns how many there were.
int add_missing(Line& line, bool avx512, unsigned state) {
  int count = 0;
  for (const Feature& f : kFeatures) {
    const bool is512 = strncmp(f.name, "512", 3) == 0;
    if (is512 != avx512 || !lists(HALFSPACE_NEEDS, f.macro) || has(f, state)) continue;
    if (count++ > 0) line.add(", ");
    line.add(is512 ? f.name + 3 : f.name);
  }
  return count;
}

}  // namespace

const char* missing_cpu_features() noexcept {
  static Line line;
  line.size = 0;
  line.text[0] = '\0';
  const unsigned state = saved_state();
  if (runs(HALFSPACE_NEEDS, state)) return line.text;

  line.add("this build needs ");
  const bool others = add_missing(line, false, state) > 0;
  const size_t before = line.size;
  line.add(others ? " and AVX-512 (" : "AVX-512 (");
  if (add_missing(line, true, state) > 0) {
    line.add(")");
  } else {
    line.text[line.size = before] = '\0';
  }
  line.add(", which this processor does not support; ");
#ifdef HALFSPACE_PORTABLE  // users of a package cannot rebuild it
  line.add("packages of halfspace need a processor with x86-64-v3");
#else
  if (runs(kLevel3, state)) {
    line.add("rebuild with -DHALFSPACE_ARCH=x86-64-v3");
  } else if (runs(kLevel2, state)) {
    line.add("rebuild with -DHALFSPACE_ARCH=x86-64-v2");
  } else {
    line.add("halfspace needs a processor with at least x86-64-v2");
  }
#endif
  return line.text;
}

#define HS_TEXT2(x) #x
#define HS_TEXT(x) HS_TEXT2(x)

const char* build_arch() noexcept { return HALFSPACE_ARCH; }

const char* build_description() noexcept { return HALFSPACE_ARCH ", " HS_TEXT(HALFSPACE_LANES) " lanes"; }

}  // namespace halfspace
