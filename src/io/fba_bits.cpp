// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The arithmetic coder is that of H.263, Annex E, with 16-bit registers and adaptive counts; cumulative counts run
// downwards, so the interval of a symbol lies between what is seen from it on and what is seen behind it.

#include "io/fba_bits.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "mien/error.hpp"

namespace mien::fba {

void BitWriter::put(std::uint32_t value, int count) {
    for (int i = count - 1; i >= 0; --i, ++position_) {
        if (position_ % 8 == 0) bytes_ += '\0';
        const auto bit = static_cast<unsigned>((value >> i) & 1U);
        bytes_.back() = static_cast<char>(static_cast<unsigned char>(bytes_.back()) | (bit << (7 - position_ % 8)));
    }
}

void BitWriter::put_start_code(std::uint32_t code) {
    if (position_ % 8 != 0) put_flag(false);
    while (position_ % 8 != 0) put_flag(true);
    put(code, 32);
}

bool BitReader::bit_at(std::size_t position) const {
    return ((std::to_integer<unsigned>(bytes_[position / 8]) >> (7 - position % 8)) & 1U) == 1;
}

std::uint32_t BitReader::get(int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i, ++position_) {
        if (position_ >= 8 * bytes_.size()) fail("expected the rest of a plane, found the end of the file");
        value = 2 * value + (bit_at(position_) ? 1U : 0U);
    }
    return value;
}

void BitReader::expect_marker() {
    if (!get_flag()) fail("expected a marker bit of 1, found 0");
}

void BitReader::fail(std::string_view sentence) const {
    throw Error(fmt::format("fba byte {}: {}", position_ / 8, sentence));
}

std::optional<std::uint32_t> BitReader::code_at(std::size_t byte) const {
    if (bytes_.size() < 4 || byte > bytes_.size() - 4) return std::nullopt;
    std::uint32_t code = 0;
    for (std::size_t i = byte; i < byte + 4; ++i) code = (code << 8) | std::to_integer<std::uint32_t>(bytes_[i]);
    return code >> 8 == 1 ? std::optional(code) : std::nullopt;
}

// Before the code stand bits up to the byte: a zero and ones, a whole byte of them or none when they end on it, or
// zeros. No plane begins so: they begin with 1 or 001.
std::optional<std::uint32_t> BitReader::start_code() {
    const std::size_t byte = (position_ + 7) / 8;
    const bool ones = byte * 8 != position_ && byte * 8 - position_ > 1 && bit_at(byte * 8 - 1);
    for (std::size_t at = position_; at < byte * 8; ++at)
        if (bit_at(at) != (ones && at != position_)) return std::nullopt;
    std::optional<std::uint32_t> code = code_at(byte);
    std::size_t end = byte + 4;
    if (!code && byte * 8 == position_ && byte < bytes_.size() && bytes_[byte] == std::byte{0x7F}) {
        code = code_at(byte + 1);
        ++end;
    }
    if (code) position_ = 8 * end;
    return code;
}

std::uint32_t Model::seen_before(std::uint32_t symbol) const {
    if (tree_.empty()) return symbol;
    std::uint32_t sum = 0;
    for (std::uint32_t i = symbol; i > 0; i &= i - 1) sum += tree_[i];
    return sum;
}

std::uint32_t Model::symbol_at(std::uint32_t count) const {
    if (tree_.empty()) return count;
    std::uint32_t at = 0, step = 1;
    while (2 * step <= size_) step *= 2;
    for (; step > 0; step /= 2)
        if (at + step <= size_ && tree_[at + step] <= count) {
            at += step;
            count -= tree_[at];
        }
    return at;
}

void Model::build(std::vector<std::uint32_t> counts) {
    tree_ = std::move(counts);
    for (std::uint32_t i = 1; i <= size_; ++i)
        if (const std::uint32_t parent = i + (i & (~i + 1)); parent <= size_) tree_[parent] += tree_[i];
}

void Model::halve() {
    std::vector<std::uint32_t> counts(size_ + 1, 0);
    total_ = 0;
    for (std::uint32_t s = 0; s < size_; ++s) {
        counts[s + 1] = (seen_before(s + 1) - seen_before(s) + 1) / 2;
        total_ += counts[s + 1];
    }
    build(std::move(counts));
}

void Model::add(std::uint32_t symbol) {
    constexpr std::uint32_t most = 16383;
    if (tree_.empty()) {
        std::vector<std::uint32_t> counts(size_ + 1, 1);
        counts[0] = 0;
        build(std::move(counts));
    }
    if (total_ == most) halve();
    for (std::uint32_t i = symbol + 1; i <= size_; i += i & (~i + 1)) ++tree_[i];
    ++total_;
}

namespace {

constexpr std::uint32_t quarter = 16384, half = 2 * quarter, three_quarters = 3 * quarter;
constexpr int longest_zeros = 22;

// How much an interval is shifted down before it is doubled; nothing while it is wide enough.
std::optional<std::uint32_t> doubling(std::uint32_t low, std::uint32_t high) {
    if (high < half) return 0;
    if (low >= half) return half;
    if (low >= quarter && high < three_quarters) return quarter;
    return std::nullopt;
}

// The part of low .. high that stands for a symbol.
void narrow(const Model& model, std::uint32_t symbol, std::uint32_t& low, std::uint32_t& high) {
    const std::uint32_t range = high - low + 1, total = model.total();
    const std::uint32_t from = total - model.seen_before(symbol), behind = total - model.seen_before(symbol + 1);
    high = low - 1 + range * from / total;
    low += range * behind / total;
}

}  // namespace

void RunWriter::put_bit(bool bit) {
    bits_.put_flag(bit);
    zeros_ = bit ? 0 : zeros_ + 1;
    if (zeros_ < longest_zeros) return;
    bits_.put_flag(true);
    zeros_ = 0;
}

void RunWriter::put_with_opposites(bool bit) {
    put_bit(bit);
    for (; opposites_ > 0; --opposites_) put_bit(!bit);
}

void RunWriter::put(const Model& model, int level) {
    narrow(model, static_cast<std::uint32_t>(level - model.low()), low_, high_);
    while (const auto shift = doubling(low_, high_)) {
        if (*shift == quarter)
            ++opposites_;
        else
            put_with_opposites(*shift == half);
        low_ = 2 * (low_ - *shift);
        high_ = 2 * (high_ - *shift) + 1;
    }
}

void RunWriter::finish() {
    ++opposites_;
    put_with_opposites(low_ >= quarter);
}

RunReader::RunReader(BitReader& bits) : bits_(bits) {
    for (int i = 0; i < 16; ++i) code_ = 2 * code_ + (get_bit() ? 1U : 0U);
}

// What stands behind the run is not stuffed, so a wrong stuffing bit there means nothing.
bool RunReader::get_bit() {
    const bool bit = bits_.get_flag();
    ++read_;
    zeros_ = bit ? 0 : zeros_ + 1;
    if (zeros_ == longest_zeros) {
        if (!bits_.get_flag() && first_bad_ == 0) first_bad_ = read_;
        zeros_ = 0;
    }
    after_[read_ % after_.size()] = bits_.position();
    return bit;
}

int RunReader::get(const Model& model) {
    const std::uint32_t range = high_ - low_ + 1;
    const std::uint32_t count = ((code_ - low_ + 1) * model.total() - 1) / range;
    const std::uint32_t symbol = model.symbol_at(model.total() - 1 - count);
    narrow(model, symbol, low_, high_);
    while (const auto shift = doubling(low_, high_)) {
        low_ = 2 * (low_ - *shift);
        high_ = 2 * (high_ - *shift) + 1;
        code_ = 2 * (code_ - *shift) + (get_bit() ? 1U : 0U);
    }
    return model.low() + static_cast<int>(symbol);
}

void RunReader::finish() {
    const std::size_t own = read_ - 14;
    bits_.seek(after_[own % after_.size()]);
    if (first_bad_ != 0 && first_bad_ <= own) bits_.fail("expected a 1 behind 22 zeros, found another 0");
}

}  // namespace mien::fba
