// Vectors named in the source, for loops that the compiler would not make wide as they should be. For
// runWithVectors(), which says how many numbers the processor's hold; bits must not depend on it.
#pragma once

#include <cstdint>
#include <utility>

namespace brisance {

template <int floats>
struct NamedVectors {
  typedef float Type __attribute__((vector_size(floats * sizeof(float))));
  typedef std::int32_t Bits __attribute__((vector_size(floats * sizeof(float))));
  /// As they lie anywhere in memory. Not for `auto`, which forgets that they need not be aligned.
  typedef float Stored __attribute__((vector_size(floats * sizeof(float)), aligned(sizeof(float)), may_alias));
  typedef std::int32_t StoredBits
      __attribute__((vector_size(floats * sizeof(float)), aligned(sizeof(float)), may_alias));

  static const Stored& at(const float* numbers) { return *reinterpret_cast<const Stored*>(numbers); }
  static Stored& at(float* numbers) { return *reinterpret_cast<Stored*>(numbers); }
  static StoredBits& bitsAt(std::int32_t* numbers) { return *reinterpret_cast<StoredBits*>(numbers); }
  static const Bits& bitsOf(const Type& v) { return reinterpret_cast<const Bits&>(v); }

  // Results come by reference: how vectors are returned depends on the instruction set.
  static void magnitude(const Type& v, Type& result) {
    constexpr std::int32_t allButSign = 0x7fffffff;
    result = reinterpret_cast<Type>(reinterpret_cast<Bits>(v) & allButSign);
  }
  /// The last of `before`, then all but the last of `here`.
  static void shift(const Type& before, const Type& here, Type& result) {
    shiftBy(before, here, result, std::make_integer_sequence<int, floats>());
  }
  /// All bits of those places of which the byte is not 0.
  static void whereSet(const std::uint8_t* bytes, Bits& result) {
    std::int32_t set[floats];
    for (int n = 0; n < floats; ++n) set[n] = bytes[n] ? -1 : 0;
    result = bitsAt(set);
  }

 private:
  template <int... n>
  static void shiftBy(const Type& before, const Type& here, Type& result, std::integer_sequence<int, n...>) {
    result = __builtin_shufflevector(before, here, (floats - 1 + n)...);
  }
};

}  // namespace brisance
