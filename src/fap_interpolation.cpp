// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The interpolation graph of ISO/IEC 14496-1 and its rational polynomials, after US 6130679. Differs from it in that
// no chain of links may lead back to where it began.

#include "mien/fap_interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <string_view>

#include "mien/error.hpp"

namespace mien {

namespace {

// ---- what a table has to be

[[noreturn]] void fail(const std::string& place, std::string_view sentence) {
    throw Error(fmt::format("fit {}: {}", place, sentence));
}

void check_fap(const std::string& place, int fap, const FapMask& seen) {
    if (fap < 3 || fap > static_cast<int>(fap_count))
        fail(place, fmt::format("expected an amplitude, FAP 3 to {}, found {}", fap_count, fap));
    if (seen[fap_index(fap)]) fail(place, fmt::format("expected each FAP of a link once, found {} again", fap));
}

void check_count(const std::string& place, std::size_t count, std::size_t least, std::size_t most) {
    if (count < least || count > most) fail(place, fmt::format("expected {} to {}, found {}", least, most, count));
}

void check_term(const std::string& place, const FitTerm& term, const FitLink& link) {
    if (!std::isfinite(term.coefficient)) fail(place + "/coefficient", "expected a finite number, found none");
    if (!term.exponents.empty() && term.exponents.size() != link.from.size())
        fail(place + "/exponents",
             fmt::format("expected one for each of {} sources, found {}", link.from.size(), term.exponents.size()));
    for (const int exponent : term.exponents)
        if (exponent < 0 || exponent > largest_fit_exponent)
            fail(place + "/exponents", fmt::format("expected 0 to {}, found {}", largest_fit_exponent, exponent));
    if (term.impulse && std::find(link.from.begin(), link.from.end(), term.impulse->fap) == link.from.end())
        fail(place + "/impulse/fap", fmt::format("expected a source of the link, found {}", term.impulse->fap));
}

void check_sum(const std::string& place, const std::vector<FitTerm>& sum, const FitLink& link, std::size_t least) {
    check_count(place, sum.size(), least, most_fit_terms);
    for (std::size_t i = 0; i < sum.size(); ++i) check_term(fmt::format("{}/{}", place, i), sum[i], link);
}

void check_target(const std::string& place, const FitTarget& target, const FitLink& link) {
    check_sum(place + "/numerator", target.numerator, link, 1);
    check_sum(place + "/denominator", target.denominator, link, 0);
    for (const FitTerm& term : target.denominator)
        if (term.impulse) fail(place + "/denominator", "expected impulses in numerators alone, found one");
}

void check_link(const std::string& place, const FitLink& link) {
    check_count(place + "/from", link.from.size(), 1, fap_count);
    check_count(place + "/to", link.to.size(), 1, fap_count);
    FapMask seen;
    for (std::size_t i = 0; i < link.from.size(); ++i) {
        check_fap(fmt::format("{}/from/{}", place, i), link.from[i], seen);
        seen.set(fap_index(link.from[i]));
    }
    for (std::size_t i = 0; i < link.to.size(); ++i) {
        const std::string here = fmt::format("{}/to/{}", place, i);
        check_fap(here + "/fap", link.to[i].fap, seen);
        seen.set(fap_index(link.to[i].fap));
        check_target(here, link.to[i], link);
    }
}

// ---- the graph

// Of each parameter, those that some link derives it from.
using Sources = std::array<FapMask, fap_count>;

Sources sources_of(const FapInterpolation& fit) {
    Sources sources;
    for (const FitLink& link : fit.links)
        for (const FitTarget& target : link.to)
            for (const int fap : link.from) sources[fap_index(target.fap)].set(fap_index(fap));
    return sources;
}

std::size_t first_of(const FapMask& mask) {
    std::size_t first = 0;
    while (first < fap_count && !mask[first]) ++first;
    return first;
}

// Every parameter in `left` follows from another one in it, so that going back from one comes round.
[[noreturn]] void fail_round(const Sources& sources, const FapMask& left) {
    std::size_t at = first_of(left);
    for (std::size_t i = 0; i < fap_count; ++i) at = first_of(sources[at] & left);
    std::string chain = fmt::format("{}", at + 1);
    const std::size_t begin = at;
    do {
        at = first_of(sources[at] & left);
        chain = fmt::format("{} -> {}", at + 1, chain);
    } while (at != begin);
    fail("/links", "expected no chain that leads back to where it began, found FAPs " + chain);
}

}  // namespace

std::vector<int> interpolated_faps(const FapInterpolation& fit) {
    check_count("/links", fit.links.size(), 0, most_fit_links);
    for (std::size_t i = 0; i < fit.links.size(); ++i) check_link(fmt::format("/links/{}", i), fit.links[i]);
    const Sources sources = sources_of(fit);
    FapMask left;
    for (std::size_t i = 0; i < fap_count; ++i) left[i] = sources[i].any();
    std::vector<int> order;
    while (left.any()) {
        std::size_t next = 0;
        while (next < fap_count && !(left[next] && (sources[next] & left).none())) ++next;
        if (next == fap_count) fail_round(sources, left);
        left.reset(next);
        order.push_back(static_cast<int>(next) + 1);
    }
    return order;
}

namespace {

using Values = std::array<std::int32_t, fap_count>;

// By multiplication alone: the same bytes whatever the mathematics library.
double power(double base, int exponent) {
    double result = 1;
    for (int i = 0; i < exponent; ++i) result *= base;
    return result;
}

double value_of(const FitTerm& term, const FitLink& link, const Values& value) {
    if (term.impulse && value[fap_index(term.impulse->fap)] != term.impulse->value) return 0;
    double product = term.coefficient;
    for (std::size_t j = 0; j < term.exponents.size(); ++j)
        product *= power(value[fap_index(link.from[j])], term.exponents[j]);
    return product;
}

double value_of(const std::vector<FitTerm>& sum, const FitLink& link, const Values& value) {
    double total = 0;
    for (const FitTerm& term : sum) total += value_of(term, link, value);
    return total;
}

}  // namespace

std::optional<std::int32_t> interpolated_value(const FitLink& link, const FitTarget& target, const Values& value) {
    const double below = target.denominator.empty() ? 1 : value_of(target.denominator, link, value);
    if (below == 0) return std::nullopt;
    const double result = std::round(value_of(target.numerator, link, value) / below);
    // Nor is infinite by infinite a value.
    if (!(std::abs(result) <= std::numeric_limits<std::int32_t>::max())) return std::nullopt;
    return static_cast<std::int32_t>(result);
}

}  // namespace mien
