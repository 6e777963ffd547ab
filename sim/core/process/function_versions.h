// SPDX-License-Identifier: BSD-3-Clause
// SEAGLINT_FUNCTION_VERSIONS("avx2", "default") before a function: it is also compiled for the processors named, one of
// which is selected at program start. Without contraction (-ffp-contract=off) all versions give the same bits as long
// as lanes are independent.
//
// Empty where the selection is missing or wrong: on other machines; with clang, which takes "arch=x86-64-v3" and then
// tests the processor's vendor (releases 14 and 16); under sanitizers, whose run-time library starts after the
// selection.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SEAGLINT_FUNCTION_VERSIONS(...) __attribute__((target_clones(__VA_ARGS__)))
#else
#define SEAGLINT_FUNCTION_VERSIONS(...)
#endif
