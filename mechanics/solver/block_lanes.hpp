// SPDX-License-Identifier: MIT
// Four lanes at a time: the inner loops that panels and their solves share.
#pragma once

#include <cstddef>

// Every function below is inlined into one that is compiled twice, for AVX2 and without: nothing
// passes four lanes through an ABI.
#pragma GCC diagnostic ignored "-Wpsabi"

// The same bytes on every processor: AVX2 has more lanes a register, not other arithmetic.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__)
#define SUNDER_LANES __attribute__((target_clones("avx2", "default")))
#else
#define SUNDER_LANES
#endif
#define SUNDER_INLINE [[gnu::always_inline]] inline

namespace sunder {

using Lanes = double __attribute__((vector_size(32), aligned(32), may_alias));

SUNDER_INLINE Lanes load(const double* p) { return *reinterpret_cast<const Lanes*>(p); }
SUNDER_INLINE void store(double* p, const Lanes& v) { *reinterpret_cast<Lanes*>(p) = v; }
SUNDER_INLINE Lanes spread(double v) { return Lanes{v, v, v, v}; }

/// C -= A B^T over `count` columns: V groups of four rows, N columns of C that are `leading` apart.
/// Column k of A begins at A[12 k]; element (j, k) of B is B[j across + k along].
template <int V, int N, std::ptrdiff_t across, std::ptrdiff_t along>
SUNDER_INLINE void subtract_product(double* C, std::ptrdiff_t leading, const double* A,
                                    const double* B, std::size_t count) {
  Lanes sum[N][V];
  for (int j = 0; j < N; ++j) {
    for (int v = 0; v < V; ++v) sum[j][v] = load(C + j * leading + 4 * v);
  }
  for (std::size_t k = 0; k < count; ++k, A += 12, B += along) {
    Lanes a[V];
    for (int v = 0; v < V; ++v) a[v] = load(A + 4 * v);
    for (int j = 0; j < N; ++j) {
      const Lanes b = spread(B[j * across]);
      for (int v = 0; v < V; ++v) sum[j][v] -= a[v] * b;
    }
  }
  for (int j = 0; j < N; ++j) {
    for (int v = 0; v < V; ++v) store(C + j * leading + 4 * v, sum[j][v]);
  }
}

/// Groups of four rows in use in tile `tile` of `vertices` rows of vertices: 1 to 3.
SUNDER_INLINE std::size_t groups_in(std::size_t tile, std::size_t vertices) {
  const std::size_t left = 3 * vertices - 12 * tile;
  return left >= 12 ? 3 : (left + 3) / 4;
}

}  // namespace sunder
