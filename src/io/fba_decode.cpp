// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// The decoder of the face animation bitstream. A plane becomes a frame only when every bit of it was there.

#include <array>
#include <fmt/format.h>
#include <limits>

#include "io/fba_bits.hpp"
#include "io/fba_levels.hpp"
#include "io/text.hpp"

#include "mien/error.hpp"
#include "mien/io/fba.hpp"

namespace mien {

namespace {

using namespace fba;

// What persists from plane to plane.
class PlaneReader {
public:
    explicit PlaneReader(std::span<const std::byte> bytes) : bits_(bytes) {}

    void expect_object() {
        const auto code = bits_.start_code();
        if (!code || *code != object_start)
            bits_.fail("expected the start code 00 00 01 BA of a face animation object" +
                       (code ? fmt::format(", found {:08X}", *code) : std::string()));
    }

    // False at the end code. Another plane may follow its own start code.
    bool next() {
        const auto code = bits_.start_code();
        if (code && *code != plane_start && *code != object_end)
            bits_.fail(fmt::format("expected a plane or the end code, found start code {:08X}", *code));
        return !code || *code != object_end;
    }

    FapFrame get_frame() {
        const bool intra = bits_.get_flag();
        const std::uint32_t kinds = bits_.get(2);
        if (kinds != 1) bits_.fail("expected a plane of face animation alone, found body animation or nothing");
        if (intra) get_clock();
        frame_.number = get_number();
        if (intra)
            get_intra_header();
        else if (!started_)
            bits_.fail("expected an intra plane first, found an inter plane");
        FapFrame frame = frame_;
        get_numbers(intra, frame);
        started_ = true;
        expected_ = frame.number + 1;
        return frame;
    }

    [[nodiscard]] double rate() const { return rate_; }

private:
    void get_clock() {
        if (bits_.get_flag()) {
            const std::uint32_t sixteenths = bits_.get(12);
            const double rate = sixteenths / 16.0 * (bits_.get_flag() ? 1000.0 / 1001 : 1);
            if (sixteenths == 0) bits_.fail("expected a frame rate above 0");
            if (started_ && rate != rate_)
                bits_.fail(fmt::format("expected one frame rate, found {} and {}", rate_, rate));
            rate_ = rate;
        }
        if (!bits_.get_flag()) return;
        bits_.get(11);  // hours and minutes
        bits_.expect_marker();
        bits_.get(6);  // seconds
    }

    std::uint32_t get_number() {
        std::uint32_t number = expected_;
        if (!bits_.get_flag()) return number;
        for (std::uint32_t skipped = 15; skipped == 15; number += skipped) {
            skipped = bits_.get(4);
            if (number > std::numeric_limits<std::int32_t>::max() - 16U)
                bits_.fail("expected frame numbers within 31 bits");
        }
        return number;
    }

    void get_intra_header() {
        quant_ = static_cast<int>(bits_.get(5));
        get_masks();
        bits_.get(1);  // gender
        if (bits_.get_flag())
            bits_.fail("expected the predictive mode, found the DCT mode, whose tables are not public");
        std::array<bool, 4> sent{};
        for (bool& flag : sent) flag = bits_.get_flag();
        if (sent[0]) get_limits(limits_.intra_high);
        if (sent[1]) get_limits(limits_.intra_low);
        if (sent[2]) get_limits(limits_.inter_high);
        if (sent[3]) get_limits(limits_.inter_low);
        for (std::size_t c = 0; c < channel_count; ++c) inter_[c] = inter_model(c, limits_, quant_);
        previous_ = {};
    }

    void get_masks() {
        frame_.mask.reset();
        frame_.interpolated.reset();
        for (std::size_t g = 0; g < frame_.interpolated.size(); ++g) {
            bits_.expect_marker();
            const std::uint32_t type = bits_.get(2);
            bool whole = true;
            for (std::size_t i = fap_group_starts[g]; i < fap_group_starts[g + 1]; ++i) {
                frame_.mask[i] = type == 3 || (type != 0 && bits_.get_flag());
                whole = whole && frame_.mask[i];
            }
            frame_.interpolated[g] = type == 2 && !whole;
        }
    }

    void get_limits(PerChannel<std::uint8_t>& limits) {
        for (std::size_t c = first_fap_channel; c < channel_count; ++c) {
            const std::size_t i = fap_of_channel(c);
            const std::size_t in_group = i - fap_group_starts[static_cast<std::size_t>(faps[i].group - 1)];
            if (in_group % 4 == 0) bits_.expect_marker();
            if (frame_.mask[i]) limits[c] = static_cast<std::uint8_t>(bits_.get(5));
        }
    }

    int get_level(RunReader& run, std::size_t channel, bool intra) {
        if (intra) return run.get(intra_model(channel, limits_, quant_));
        Model& model = inter_[channel];
        const int level = run.get(model);
        model.add(static_cast<std::uint32_t>(level - model.low()));
        return level;
    }

    void get_run(bool intra, std::size_t begin, std::size_t end) {
        RunReader run(bits_);
        for (std::size_t c = begin; c < end; ++c)
            if (frame_.mask[fap_of_channel(c)])
                previous_[c] = rebuilt(c, previous_[c], get_level(run, c, intra), step_of(c, quant_));
        run.finish();
        for (std::size_t c = begin; c < end; ++c) check_number(c);
    }

    void check_number(std::size_t channel) {
        const std::int64_t number = previous_[channel];
        const bool select = kind_of(channel) == ChannelKind::select;
        const auto most =
            static_cast<std::int64_t>(fap_of_channel(channel) == 0 ? viseme_names.size() : expression_names.size());
        if (select && (number < 0 || number >= most))
            bits_.fail(fmt::format("expected a selection from 0 to {}, found {}", most - 1, number));
        if (number < std::numeric_limits<std::int32_t>::min() || number > std::numeric_limits<std::int32_t>::max())
            bits_.fail("expected values within 32 bits");
    }

    void get_numbers(bool intra, FapFrame& frame) {
        if (frame.mask[0]) {
            get_run(intra, 0, first_expression_channel);
            frame.viseme.define = bits_.get_flag();
        }
        if (frame.mask[1]) {
            get_run(intra, first_expression_channel, first_fap_channel);
            frame.expression.init_face = bits_.get_flag();
            frame.expression.define = bits_.get_flag();
        }
        if ((frame.mask >> 2).any()) get_run(intra, first_fap_channel, channel_count);
        set_numbers(frame, previous_);
    }

    BitReader bits_;
    FapFrame frame_;  // number, mask and what is interpolated; no values
    bool started_ = false;
    int quant_ = 0;
    double rate_ = 25;
    std::uint32_t expected_ = 0;
    Limits limits_ = standard_limits();
    PerChannel<Model> inter_;
    PerChannel<std::int64_t> previous_{};
};

// A frame of few parameters can be less than a byte long and takes 300 in memory: a day and a half at 30 a second.
constexpr std::size_t most_frames = 4000000;

}  // namespace

DecodedFaps parse_fba(std::span<const std::byte> bytes) {
    check_size(bytes, "fba");
    PlaneReader reader(bytes);
    reader.expect_object();
    DecodedFaps decoded;
    auto& frames = decoded.stream.frames;
    try {
        while (reader.next()) {
            if (frames.size() == most_frames) throw Error(fmt::format("fba: expected at most {} frames", most_frames));
            frames.push_back(reader.get_frame());
        }
        if (frames.empty()) throw Error("fba: expected at least one frame, found none");
    } catch (const Error& error) {
        if (frames.empty()) throw;
        decoded.cut = error.what();
    }
    decoded.stream.rate = reader.rate();
    return decoded;
}

}  // namespace mien
