// Wide vectors chosen at run time: one source for a loop, compiled for three instruction sets, the same bits from each
// (no fused multiply-add, no reordered sums: the compiler may only do several independent elements at once).
#pragma once

namespace brisance {

enum class VectorPath { plain, avx2, avx512 };

/// The widest path that this processor runs, or a narrower one set by forceVectorPath or
/// BRISANCE_VECTOR=plain|avx2|avx512.
VectorPath vectorPath();
/// For tests: use `path` if the processor has it, else the widest below it.
void forceVectorPath(VectorPath path);

namespace detail {
template <class Body>
[[gnu::flatten, gnu::noinline, gnu::target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")]] void
runAvx512(const Body& body) {
  body();
}
template <class Body>
[[gnu::flatten, gnu::noinline, gnu::target("avx2")]] void runAvx2(const Body& body) {
  body();
}
}  // namespace detail

/// Runs body(), with everything it calls inlined and compiled for the processor at hand.
template <class Body>
void runWide(const Body& body) {
  switch (vectorPath()) {
    case VectorPath::avx512:
      return detail::runAvx512(body);
    case VectorPath::avx2:
      return detail::runAvx2(body);
    case VectorPath::plain:
      return body();
  }
}

/// Likewise body.operator()<floats>(), for as many floats as the widest vectors of the path hold: where vectors are
/// named in the source. The bits must not depend on it.
template <class Body>
void runWithVectors(const Body& body) {
  switch (vectorPath()) {
    case VectorPath::avx512:
      return detail::runAvx512([&] { body.template operator()<16>(); });
    case VectorPath::avx2:
      return detail::runAvx2([&] { body.template operator()<8>(); });
    case VectorPath::plain:
      return body.template operator()<4>();
  }
}

}  // namespace brisance
