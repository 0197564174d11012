// SPDX-License-Identifier: BSD-3-Clause
// Protection against subroutines that write where they must not: arrays between guard words, and a comparison
// of the inputs before and after a call.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace host {

/// NaNs that do not result from arithmetic: guard words around every array, and the content of outputs before a call. On
/// x86 a number computed from one of them keeps its bits, so that the check of results finds a subroutine that reads
/// beyond an array or does not write an output, and tells which.
inline constexpr std::uint64_t guard_bits = 0x7ff85afe5afe5afe, unwritten_bits = 0x7ff8deafdeafdeaf;
inline const double guard_word = std::bit_cast<double>(guard_bits),
                    unwritten_word = std::bit_cast<double>(unwritten_bits);

inline bool has_bits(double x, std::uint64_t bits) {
  return std::bit_cast<std::uint64_t>(x) == bits;
}

/// An array for a subroutine, with 8 guard words before it and 8 + `slack` after it, so that a subroutine that assumes a
/// larger block overwrites nothing else before it is stopped.
class GuardedArray {
public:
  static constexpr std::size_t guards = 8;

  void assign(std::size_t size, double value, std::size_t slack) {
    length = size;
    words.assign(size + 2 * guards + slack, guard_word);
    std::fill_n(data(), size, value);
  }
  /// Takes over as many values; throws std::length_error if their number differs.
  GuardedArray& operator=(const std::vector<double>& values) {
    if (values.size() != length) throw std::length_error("an array of a block keeps its size");
    std::copy(values.begin(), values.end(), begin());
    return *this;
  }
  operator std::vector<double>() const { return {begin(), end()}; }

  double* data() { return words.data() + guards; }
  const double* data() const { return words.data() + guards; }
  std::size_t size() const { return length; }
  double& operator[](std::size_t i) { return data()[i]; }
  const double& operator[](std::size_t i) const { return data()[i]; }
  double* begin() { return data(); }
  double* end() { return data() + length; }
  const double* begin() const { return data(); }
  const double* end() const { return data() + length; }

  bool intact_before() const { return intact(words.data()); }
  bool intact_after() const { return intact(data() + length); }
  /// The same with the slack.
  bool intact_far_after() const { return intact(data() + length, words.size() - guards - length); }

private:
  static bool intact(const double* word, std::size_t count = guards) {
    std::uint64_t differing = 0;
    for (std::size_t i = 0; i < count; ++i) differing |= std::bit_cast<std::uint64_t>(word[i]) ^ guard_bits;
    return differing == 0;
  }
  std::vector<double, Eigen::aligned_allocator<double>> words;
  std::size_t length = 0;
};

/// Integers or characters for a subroutine, with guard words at both ends.
template <class Word, Word guard> class GuardedWords {
public:
  static constexpr std::size_t guards = 16;

  /// The words between the guards are to be written by the caller.
  explicit GuardedWords(std::size_t size) : words(size + 2 * guards, guard) {}
  Word* data() { return words.data() + guards; }
  std::size_t size() const { return words.size() - 2 * guards; }
  bool intact_before() const { return intact(words.data()); }
  bool intact_after() const { return intact(words.data() + guards + size()); }

private:
  static bool intact(const Word* word) {
    int differing = 0;
    for (std::size_t i = 0; i < guards; ++i) differing |= word[i] ^ guard;
    return differing == 0;
  }
  std::vector<Word> words;
};
using GuardedIntegers = GuardedWords<int, 0x5afe5afe>;
using GuardedText = GuardedWords<char, '\x1a'>;

struct Material;
struct VumatBlock;

/// Throws std::runtime_error naming material and array if a constant of the material or one of the 8 guard words on either
/// side of an array has changed; with `far` also if one of the slack has.
void check_guards(const Material& material, const VumatBlock& block, bool far);

/// Copies all inputs of a call into the block's `input_copy`.
void copy_inputs(VumatBlock& block);
/// Throws std::runtime_error naming material and array if an input differs from the copy.
void check_inputs(const Material& material, const VumatBlock& block);
void restore_inputs(VumatBlock& block);

} // namespace host
