// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The coder of the face animation bitstream. What is coded is settled first, frame by frame as the decoder will see it;
// then, from one intra plane to the next, the tightest limits around it; then it is written.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <utility>
#include <vector>

#include "io/fba_bits.hpp"
#include "io/fba_levels.hpp"

#include "mien/error.hpp"
#include "mien/io/fba.hpp"

namespace mien {

namespace {

using namespace fba;

// A frame as it is coded.
struct Plane {
    bool intra = false;
    PerChannel<std::int32_t> levels{};
};

struct Quantised {
    std::vector<Plane> planes;
    FapStream decoded;
    std::size_t clamped = 0;
};

// Frames per second are sent in sixteenths, which may be stretched for the rates of American television.
struct CodedRate {
    std::uint32_t sixteenths = 0;
    bool stretched = false;
    double rate = 0;
};

CodedRate coded_rate(double rate) {
    if (!(rate > 0.03 && rate < 256))
        throw Error(fmt::format("fba: expected 1/16 to 255 frames a second, found {}", rate));
    CodedRate best;
    for (const bool stretched : {false, true}) {
        const double scale = stretched ? 1000.0 / 1001 : 1;
        const auto sixteenths = static_cast<std::uint32_t>(std::clamp(std::round(rate / scale * 16), 1.0, 4095.0));
        const CodedRate coded{sixteenths, stretched, sixteenths / 16.0 * scale};
        if (best.rate == 0 || std::abs(coded.rate - rate) < std::abs(best.rate - rate)) best = coded;
    }
    return best;
}

void check_frame(const FapFrame& frame, std::uint32_t expected) {
    constexpr std::uint32_t most_skipped = 1000000, last = 2147483000;
    if (frame.number < expected || frame.number - expected > most_skipped || frame.number > last)
        throw Error(fmt::format("fba: expected a frame number from {} to {}, found {}", expected,
                                std::min(expected + most_skipped, last), frame.number));
    const Viseme& v = frame.viseme;
    const Expression& e = frame.expression;
    if (v.select1 > 14 || v.select2 > 14 || v.blend > 63)
        throw Error(fmt::format("fba frame {}: expected visemes 0 to 14 and a blend up to 63", frame.number));
    if (e.select1 > 6 || e.select2 > 6 || e.intensity1 > 63 || e.intensity2 > 63)
        throw Error(fmt::format("fba frame {}: expected expressions 0 to 6, intensities up to 63", frame.number));
}

bool is_whole(const FapMask& mask, std::size_t group) {
    for (std::size_t i = fap_group_starts[group]; i < fap_group_starts[group + 1]; ++i)
        if (!mask[i]) return false;
    return true;
}

// The frame without its numbers: a group that is sent as a whole leaves nothing to interpolate.
FapFrame frame_without_numbers(const FapFrame& frame) {
    FapFrame bare;
    bare.number = frame.number;
    bare.mask = frame.mask;
    for (std::size_t g = 0; g < bare.interpolated.size(); ++g)
        bare.interpolated[g] = frame.interpolated[g] && !is_whole(frame.mask, g);
    if (frame.mask[0]) bare.viseme.define = frame.viseme.define;
    if (frame.mask[1]) bare.expression.define = frame.expression.define;
    if (frame.mask[1]) bare.expression.init_face = frame.expression.init_face;
    return bare;
}

// Quantises one frame after another; keeps what the decoder predicts from.
class Quantiser {
public:
    Quantiser(int quant, std::size_t intra_every) : quant_(quant), intra_every_(intra_every) {}

    void add(const FapFrame& frame, Quantised& result) {
        FapFrame decoded = frame_without_numbers(frame);
        const auto numbers = within_reach(numbers_of(frame), result.clamped);
        Plane plane;
        const bool same_mask = !result.planes.empty() && decoded.mask == result.decoded.frames.back().mask &&
                               decoded.interpolated == result.decoded.frames.back().interpolated;
        const bool due = intra_every_ > 0 && since_intra_ >= intra_every_;
        plane.intra = !same_mask || due || !predict(numbers, plane.levels);
        if (plane.intra) {
            previous_ = {};
            predict(numbers, plane.levels);
            since_intra_ = 0;
        }
        ++since_intra_;
        for (std::size_t c = 0; c < channel_count; ++c)
            previous_[c] = rebuilt(c, previous_[c], plane.levels[c], step_of(c, quant_));
        set_numbers(decoded, previous_);
        result.planes.push_back(plane);
        result.decoded.frames.push_back(decoded);
    }

private:
    PerChannel<std::int64_t> within_reach(PerChannel<std::int64_t> numbers, std::size_t& clamped) const {
        for (std::size_t c = first_fap_channel; c < channel_count; ++c) {
            const std::int64_t reach = levels_in(most_limit, quant_) * step_of(c, quant_);
            if (std::abs(numbers[c]) <= reach) continue;
            numbers[c] = std::clamp(numbers[c], -reach, reach);
            ++clamped;
        }
        return numbers;
    }

    // Levels of the differences; false when one is out of reach.
    bool predict(const PerChannel<std::int64_t>& numbers, PerChannel<std::int32_t>& levels) const {
        for (std::size_t c = 0; c < channel_count; ++c) {
            const std::int64_t level = level_of(numbers[c] - previous_[c], step_of(c, quant_));
            if (c >= first_fap_channel && std::abs(level) > levels_in(most_limit, quant_)) return false;
            levels[c] = static_cast<std::int32_t>(level);
        }
        return true;
    }

    int quant_;
    std::size_t intra_every_, since_intra_ = 0;
    PerChannel<std::int64_t> previous_{};
};

Quantised quantise(const FapStream& stream, int quant, std::size_t intra_every) {
    Quantised result;
    Quantiser quantiser(quant, intra_every);
    std::uint32_t expected = 0;
    for (const FapFrame& frame : stream.frames) {
        check_frame(frame, expected);
        expected = frame.number + 1;
        quantiser.add(frame, result);
    }
    return result;
}

void widen(std::uint8_t& limit, std::int64_t level, int quant) {
    limit = std::max(limit, static_cast<std::uint8_t>(limit_for(std::max<std::int64_t>(level, 0), quant)));
}

// Around the levels of the intra plane and of the inter planes that follow it.
Limits limits_from(const std::vector<Plane>& planes, std::size_t intra, int quant) {
    Limits limits;
    for (std::size_t f = intra; f < planes.size() && (f == intra || !planes[f].intra); ++f)
        for (std::size_t c = first_fap_channel; c < channel_count; ++c) {
            const std::int64_t level = planes[f].levels[c];
            widen(f == intra ? limits.intra_high[c] : limits.inter_high[c], level, quant);
            widen(f == intra ? limits.intra_low[c] : limits.inter_low[c], -level, quant);
        }
    return limits;
}

void put_skipped(BitWriter& bits, std::uint32_t skipped) {
    bits.put_flag(skipped > 0);
    if (skipped == 0) return;
    for (; skipped >= 15; skipped -= 15) bits.put(15, 4);
    bits.put(skipped, 4);
}

void put_masks(BitWriter& bits, const FapFrame& frame) {
    for (std::size_t g = 0; g < frame.interpolated.size(); ++g) {
        bits.put_flag(true);  // marker
        const std::size_t begin = fap_group_starts[g], end = fap_group_starts[g + 1];
        const bool whole = is_whole(frame.mask, g);
        bool any = false;
        for (std::size_t i = begin; i < end; ++i) any = any || frame.mask[i];
        bits.put(whole ? 3 : frame.interpolated[g] ? 2 : any ? 1 : 0, 2);
        if (whole || (!any && !frame.interpolated[g])) continue;
        for (std::size_t i = begin; i < end; ++i) bits.put_flag(frame.mask[i]);
    }
}

void put_limits(BitWriter& bits, const FapMask& mask, const PerChannel<std::uint8_t>& limits) {
    for (std::size_t c = first_fap_channel; c < channel_count; ++c) {
        const std::size_t i = fap_of_channel(c);
        const std::size_t in_group = i - fap_group_starts[static_cast<std::size_t>(faps[i].group - 1)];
        if (in_group % 4 == 0) bits.put_flag(true);  // marker
        if (mask[i]) bits.put(limits[c], 5);
    }
}

// One stream on its way into bits: the models of the present intra plane and of the inter planes behind it.
class PlaneWriter {
public:
    PlaneWriter(int quant, const CodedRate& rate) : quant_(quant), rate_(rate) { bits_.put(object_start, 32); }

    void begin_segment(const Limits& limits) {
        limits_ = limits;
        for (std::size_t c = 0; c < channel_count; ++c) inter_[c] = inter_model(c, limits, quant_);
    }

    void put(const Plane& plane, const FapFrame& frame) {
        if (plane.intra) bits_.put_start_code(plane_start);
        bits_.put_flag(plane.intra);
        bits_.put(1, 2);  // a face, no body
        if (plane.intra) put_clock();
        put_skipped(bits_, frame.number - expected_);
        expected_ = frame.number + 1;
        if (plane.intra) put_intra_header(frame);
        put_numbers(plane, frame);
    }

    std::string finish() {
        bits_.put_start_code(object_end);
        return bits_.take();
    }

private:
    void put_clock() {
        bits_.put_flag(!rate_sent_);
        if (!rate_sent_) {
            bits_.put(rate_.sixteenths / 16, 8);
            bits_.put(rate_.sixteenths % 16, 4);
            bits_.put_flag(rate_.stretched);
        }
        rate_sent_ = true;
        bits_.put_flag(false);  // no time code
    }

    void put_intra_header(const FapFrame& frame) {
        bits_.put(static_cast<std::uint32_t>(quant_), 5);
        put_masks(bits_, frame);
        bits_.put(0, 1);    // gender
        bits_.put(0, 1);    // predictive
        bits_.put(0xF, 4);  // all limits follow
        for (const auto* limits : {&limits_.intra_high, &limits_.intra_low, &limits_.inter_high, &limits_.inter_low})
            put_limits(bits_, frame.mask, *limits);
    }

    void put_run(const Plane& plane, const FapMask& mask, std::size_t begin, std::size_t end) {
        RunWriter run(bits_);
        for (std::size_t c = begin; c < end; ++c) {
            if (!mask[fap_of_channel(c)]) continue;
            const int level = plane.levels[c];
            if (plane.intra) {
                run.put(intra_model(c, limits_, quant_), level);
            } else {
                run.put(inter_[c], level);
                inter_[c].add(static_cast<std::uint32_t>(level - inter_[c].low()));
            }
        }
        run.finish();
    }

    void put_numbers(const Plane& plane, const FapFrame& frame) {
        if (frame.mask[0]) {
            put_run(plane, frame.mask, 0, first_expression_channel);
            bits_.put_flag(frame.viseme.define);
        }
        if (frame.mask[1]) {
            put_run(plane, frame.mask, first_expression_channel, first_fap_channel);
            bits_.put_flag(frame.expression.init_face);
            bits_.put_flag(frame.expression.define);
        }
        if ((frame.mask >> 2).any()) put_run(plane, frame.mask, first_fap_channel, channel_count);
    }

    int quant_;
    CodedRate rate_;
    bool rate_sent_ = false;
    std::uint32_t expected_ = 0;
    BitWriter bits_;
    Limits limits_;
    PerChannel<Model> inter_;
};

EncodedFaps encode(const FapStream& stream, int quant, std::size_t intra_every) {
    const CodedRate rate = coded_rate(stream.rate);
    Quantised quantised = quantise(stream, quant, intra_every);
    PlaneWriter writer(quant, rate);
    for (std::size_t f = 0; f < quantised.planes.size(); ++f) {
        if (quantised.planes[f].intra) writer.begin_segment(limits_from(quantised.planes, f, quant));
        writer.put(quantised.planes[f], quantised.decoded.frames[f]);
    }
    quantised.decoded.rate = rate.rate;
    EncodedFaps encoded{writer.finish(), std::move(quantised.decoded), quant, quantised.clamped, 0};
    const auto lasting = stream.frames.back().number - stream.frames.front().number + 1;
    encoded.kilobits_per_second = 8 * static_cast<double>(encoded.bytes.size()) * rate.rate / lasting / 1000;
    return encoded;
}

}  // namespace

EncodedFaps format_fba(const FapStream& stream, const FbaOptions& options) {
    if (stream.frames.empty()) throw Error("fba: expected at least one frame, found none");
    if (options.quant < 0 || options.quant > 31)
        throw Error(fmt::format("fba: expected a quantiser from 0 to 31, found {}", options.quant));
    EncodedFaps encoded = encode(stream, options.quant, options.intra_every);
    if (!(options.kilobits_per_second > 0)) return encoded;
    for (int quant = options.quant + 1; encoded.kilobits_per_second > options.kilobits_per_second; ++quant) {
        if (quant > 31)
            throw Error(fmt::format("fba: expected at most {} kbit/s, found {:.2f} with the coarsest quantiser",
                                    options.kilobits_per_second, encoded.kilobits_per_second));
        encoded = encode(stream, quant, options.intra_every);
    }
    return encoded;
}

}  // namespace mien
