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

/// NaNs that no arithmetic makes: what is around every array, and what is in outputs that are still to be written. A
/// number that is computed from one keeps its bits on x86, so that a subroutine that reads beyond an array or
/// leaves an output is found out by the check for numbers.
inline constexpr std::uint64_t guard_bits = 0x7ff85afe5afe5afe, unwritten_bits = 0x7ff8deafdeafdeaf;
inline const double guard_word = std::bit_cast<double>(guard_bits),
                    unwritten_word = std::bit_cast<double>(unwritten_bits);

inline bool has_bits(double x, std::uint64_t bits) {
  return std::bit_cast<std::uint64_t>(x) == bits;
}

/// An array for a subroutine: 8 guard words before it, 8 after it, and `slack` more of them, so that a subroutine
/// that takes a block for a larger one damages nothing before it is stopped.
class GuardedArray {
public:
  static constexpr std::size_t guards = 8;

  void assign(std::size_t size, double value, std::size_t slack) {
    length = size;
    words.assign(size + 2 * guards + slack, guard_word);
    std::fill_n(data(), size, value);
  }
  /// Takes the values of as many numbers.
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
  /// The slack as well.
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

  /// Its words are the caller's to write.
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

/// Throws std::runtime_error naming material and array if a guard word next to an array or a constant of the
/// material changed; with `far` if any guard word did.
void check_guards(const Material& material, const VumatBlock& block, bool far);

/// Copies all inputs of a call into the block's `input_copy`.
void copy_inputs(VumatBlock& block);
/// Throws std::runtime_error naming material and array if an input differs from the copy.
void check_inputs(const Material& material, const VumatBlock& block);
void restore_inputs(VumatBlock& block);

} // namespace host
