// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Before a function: compiled for wider registers where the machine has them. AVX2
/// without fused multiply-add rounds as SSE2 does, so that results are the same bytes.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define MYOTET_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define MYOTET_WIDE
#endif
