// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "mien/fap.hpp"

namespace mien {

struct FbaOptions {
    /// Quantiser, 0 to 31: a level is as many steps of the table. 0 codes the values as they are, up to 1860 units.
    int quant = 1;
    /// Above 0: the finest quantiser, from `quant` on, with which the whole stream keeps to it.
    double kilobits_per_second = 0;
    /// A plane that can be read without those before it, at least every so many frames; 0: only where one is needed.
    std::size_t intra_every = 0;
};

/// A coded stream, and what its reader will get.
struct EncodedFaps {
    std::string bytes;
    FapStream decoded;        ///< what parse_fba gives back: quantised, with the rate in sixteenths
    int quant = 0;            ///< the quantiser that was taken
    std::size_t clamped = 0;  ///< values that lay outside what the quantiser reaches and were moved to its end
    double kilobits_per_second = 0;
};

/// The face animation bitstream of ISO/IEC 14496-2 in predictive mode: differences to the frame before, quantised and
/// coded by an adaptive arithmetic coder. Limits are always sent, since decoders do not agree on defaults; they are the
/// tightest around the values, because what a symbol costs grows with what it could have been. A frame whose mask is
/// another one, or that moves too far at once, is coded on its own. Version and name of the stream are not kept.
///
/// Throws Error if the stream has no frame, a rate outside 1/16 to 255 15/16 (or that times 1000/1001), numbers that do
/// not rise or leave out more than a million, a viseme or an expression that does not exist, a quantiser outside 0 to
/// 31, or if no quantiser keeps to the rate that is asked for.
EncodedFaps format_fba(const FapStream& stream, const FbaOptions& options = {});

struct DecodedFaps {
    FapStream stream;
    /// Where and why reading ended before the end code; empty when the stream is whole. No part of a frame is kept.
    std::string cut;
};

/// Reads it back. Throws Error when not even one frame is whole: no object start code, body animation, DCT mode (its
/// tables are not public), a marker bit that is not set.
DecodedFaps parse_fba(std::span<const std::byte> bytes);

}  // namespace mien
