// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mien/fap.hpp"

namespace mien {

/// What a table may hold: a term's exponents and the terms of a sum as the fields of the standard's FIT node have room
/// for, and links at all.
inline constexpr int largest_fit_exponent = 15;
inline constexpr std::size_t most_fit_terms = 10, most_fit_links = 1024;

/// Lets a term count only where a source has one value: a factor that is 1 there and 0 elsewhere.
struct FitImpulse {
    int fap = 0;             ///< a source of the link
    std::int32_t value = 0;  ///< FAP units
    friend constexpr bool operator==(const FitImpulse&, const FitImpulse&) = default;
};

/// coefficient * (each source to the power of its exponent) * impulse.
struct FitTerm {
    double coefficient = 0;             ///< finite; takes FAP units to FAP units
    std::vector<int> exponents;         ///< one per source of the link, in its order, 0 to 15; empty: all 0
    std::optional<FitImpulse> impulse;  ///< in numerators only
    friend bool operator==(const FitTerm&, const FitTerm&) = default;
};

/// How one parameter follows from the sources of a link: the sum of the numerator over that of the denominator.
struct FitTarget {
    int fap = 0;
    std::vector<FitTerm> numerator;    ///< 1 to 10 terms
    std::vector<FitTerm> denominator;  ///< up to 10; empty: 1
    friend bool operator==(const FitTarget&, const FitTarget&) = default;
};

/// From a set of parameters to a set of others. Parameters are 3 to 68: FAPs 1 and 2 are no amplitudes, and what they
/// ask for is said by the others before a table is looked at.
struct FitLink {
    std::vector<int> from;      ///< at least one, each once
    std::vector<FitTarget> to;  ///< at least one, each parameter once, none of `from`
    friend bool operator==(const FitLink&, const FitLink&) = default;
};

/// The FAP interpolation table (FIT) of ISO/IEC 14496-1: how parameters that a stream leaves out follow from those
/// that it sends, F = sum(c_i * prod FAP_j ^ l_ij) / sum(b_i * prod FAP_j ^ m_ij), with an optional impulse in each
/// term of the numerator. After H. H. Chen and H. Tao, "Data reduction and representation method for graphic
/// articulation parameters (GAPs)", US 6130679 (2000; expired).
///
/// Where what we know of the standard is silent, this holds:
/// - The place in the list is the priority: of the links that could give a parameter, the first one does whose sources
///   are all known, one by one from the stream or from other links.
/// - So the order of evaluation does not matter, provided that no chain of links leads back to where it began. Such
///   tables are refused, although a decoder could give them a meaning. A table cannot copy both ways; the rules for the
///   sides of the face and the contours of the lips, which follow it, can.
/// - A denominator of 0, or a value beyond 32 bits, gives nothing: the next link is asked, or the parameter stays
/// unknown.
/// - Values are rounded to whole units, half away from zero, before other links use them. 0 to the power of 0 is 1.
struct FapInterpolation {
    std::vector<FitLink> links;
    friend bool operator==(const FapInterpolation&, const FapInterpolation&) = default;
};

/// The parameters that a table can give, each after all those that it may follow from. Throws Error that names the
/// place ("/links/0/to/1/fap") if the table is not as described above, or the chain of parameters that leads back.
std::vector<int> interpolated_faps(const FapInterpolation& fit);

/// The value of a target of `link` where `value` holds those of its sources, by index; nothing where the denominator is
/// 0 or the value beyond 32 bits. The table is one that `interpolated_faps` accepts.
std::optional<std::int32_t> interpolated_value(const FitLink& link, const FitTarget& target,
                                               const std::array<std::int32_t, fap_count>& value);

}  // namespace mien
