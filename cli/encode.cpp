// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <filesystem>
#include <memory>

#include "fap_files.hpp"
#include "outputs.hpp"

namespace mien::cli {

namespace {

struct Recode {
    std::filesystem::path input;
    FapOutput output;
};

void recode(Call& call, const Recode& flags) {
    check_output(flags.output.output, {flags.input}, call.flags);
    write_faps(call, flags.output, load_faps(flags.input, call.report));
}

}  // namespace

void add_encode(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<Recode>();
    CLI::App* verb =
        add_verb(app, call, "encode", "Codes face animation parameters as an MPEG-4 bitstream.",
                 "mien encode smile.fap -o smile.fba --quant 4 --bitrate 4", [&call, flags] { recode(call, *flags); });
    verb->add_option("faps", flags->input, "the parameters: .fap .fba")->required();
    add_fap_output_flags(*verb, flags->output);
}

void add_decode(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<Recode>();
    CLI::App* verb = add_verb(app, call, "decode", "Writes an MPEG-4 face animation bitstream as text.",
                              "mien decode smile.fba -o smile.fap", [&call, flags] { recode(call, *flags); });
    verb->add_option("stream", flags->input, "the bitstream: .fba .fap")->required();
    add_fap_output_flags(*verb, flags->output);
}

}  // namespace mien::cli
