// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <ostream>

#include "interrupt.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "stage.hpp"

#include "mien/draw/sheet.hpp"
#include "mien/error.hpp"
#include "mien/io/png.hpp"
#include "mien/io/video.hpp"
#include "mien/io/write.hpp"

namespace mien::cli {

namespace fs = std::filesystem;

namespace {

struct Render {
    fs::path input, take, output;
    std::vector<fs::path> compare;
    LookFlags look;
    PaintFlags paint;
    double fps = 30, time = 0;
    bool sheet = false;
    std::size_t pictures = 12;
    std::string title;
};

enum class Form { still, sheet, video, frames };

Form form_of(const Render& flags) {
    const std::string extension = flags.output.extension().string();
    if (extension == ".png") return flags.sheet ? Form::sheet : Form::still;
    if (flags.sheet) throw Error("--sheet: expected an output that ends in .png, found " + flags.output.string());
    return extension.empty() ? Form::frames : Form::video;
}

std::string check_extension(const std::string& name) {
    const std::string extension = fs::path(name).extension().string();
    if (extension.empty() || extension == ".png" || extension == ".mp4" || extension == ".webm") return {};
    return "expected .png, .mp4, .webm, or a folder name without extension for .png frames, found " + name;
}

Size size_for(const Render& flags, Form form) {
    return size_of(flags.look.size, form == Form::sheet ? Size{300, 380} : Size{640, 480});
}

// Soft light takes many passes; where many pictures are asked for, fewer do.
LookFlags look_for(const Render& flags, Form form) {
    LookFlags look = flags.look;
    if (look.passes == 0) look.passes = form == Form::still ? 64 : form == Form::sheet ? 32 : 12;
    look.time = form == Form::still ? flags.time : 0;
    return look;
}

std::string caption(double time) {
    return fmt::format("{:.2f} s", time);
}

// All actors at one time: one picture, or several side by side with their names.
Picture together(Stage& stage, double time) {
    std::vector<Picture> pictures;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < stage.size(); ++i) {
        pictures.push_back(stage.picture(i, time));
        names.push_back(stage.name(i));
    }
    if (pictures.size() == 1 && !stage.legend()) return pictures.front();
    SheetOptions options;
    options.columns = static_cast<std::uint32_t>(pictures.size() == 4 ? 2 : std::min<std::size_t>(pictures.size(), 3));
    options.legend = stage.legend();
    return contact_sheet(pictures, names, options);
}

Picture sheet(Stage& stage, const Render& flags, Progress& progress) {
    const std::vector<double> times = stage.key_times(flags.pictures);
    std::vector<Picture> pictures;
    GridNames names;
    for (const double time : times) names.columns.push_back(caption(time));
    for (std::size_t i = 0; i < stage.size(); ++i) {
        names.rows.push_back(stage.name(i));
        for (const double time : times) {
            stop_if_interrupted();
            pictures.push_back(stage.picture(i, time));
            progress(pictures.size(), stage.size() * times.size());
        }
    }
    SheetOptions options;
    options.title = flags.title.empty() && stage.size() == 1 ? stage.name(0) : flags.title;
    options.legend = stage.legend();
    return stage.size() == 1 ? contact_sheet(pictures, names.columns, options) : grid(pictures, names, options);
}

// Rows 0, 1, ... at the frame rate, the last one not beyond the end.
std::size_t frame_count(const Stage& stage, double fps) {
    return static_cast<std::size_t>(std::floor(stage.seconds() * fps + 1e-6)) + 1;
}

void write_video(Stage& stage, const Render& flags, bool overwrite, Progress& progress) {
    const std::size_t count = frame_count(stage, flags.fps);
    std::optional<VideoWriter> writer;
    for (std::size_t frame = 0; frame < count; ++frame) {
        stop_if_interrupted();
        const Picture picture = together(stage, static_cast<double>(frame) / flags.fps);
        if (!writer) writer.emplace(flags.output, picture.width, picture.height, flags.fps, VideoOptions{overwrite});
        writer->add(picture);
        progress(frame + 1, count);
    }
    writer->finish();
}

void write_bytes(std::ostream& out, const std::vector<std::byte>& bytes) {
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

void write_frames(Stage& stage, const Render& flags, const WriteOptions& options, Progress& progress) {
    const std::size_t count = frame_count(stage, flags.fps);
    write_folder({".png", count,
                  [&](std::size_t frame, std::ostream& out) {
                      stop_if_interrupted();
                      write_bytes(out, format_png(together(stage, static_cast<double>(frame) / flags.fps)));
                      progress(frame + 1, count);
                  }},
                 flags.output, options);
}

void write(Call& call, Stage& stage, const Render& flags, Form form) {
    WriteOptions options;
    options.overwrite = call.flags.force;
    Progress progress("drawing", call.flags.quiet || call.flags.json);
    if (form == Form::video) write_video(stage, flags, call.flags.force, progress);
    if (form == Form::frames) write_frames(stage, flags, options, progress);
    if (form == Form::still) write_file(flags.output, format_png(together(stage, flags.time)), options);
    if (form == Form::sheet) write_file(flags.output, format_png(sheet(stage, flags, progress)), options);
}

void render(Call& call, const Render& flags) {
    const Form form = form_of(flags);
    std::vector<fs::path> inputs{flags.input, flags.take, flags.paint.truth};
    inputs.insert(inputs.end(), flags.compare.begin(), flags.compare.end());
    check_output(flags.output, inputs, call.flags);
    Stage stage(look_for(flags, form), flags.paint, size_for(flags, form));
    stage.enter(load_actor(flags.input, flags.take, call.report["drawn"]));
    for (const fs::path& other : flags.compare) {
        Report about;
        stage.enter(load_actor(other, {}, about));
        call.report["compared"].push_back(about);
    }
    if (!flags.paint.truth.empty()) stage.set_truth(load_actor(flags.paint.truth, {}, call.report["truth"]));
    call.report["device"] = stage.device();
    if (call.flags.dry_run) return;
    listen_for_interrupts();
    write(call, stage, flags, form);
    call.report["wrote"] = {{"file", flags.output.string()}};
    if (form == Form::video || form == Form::frames) call.report["wrote"]["frames"] = frame_count(stage, flags.fps);
}

}  // namespace

void add_render(CLI::App& app, Call& call) {
    const auto flags = std::make_shared<Render>();
    CLI::App* verb =
        add_verb(app, call, "render", "Draws a head, still or moving, as a picture, a sheet of pictures or a video.",
                 "mien render kate-smiles.glb -o kate-smiles.mp4\n"
                 "  mien render kate-rig.glb --take smile-on-kate.csv --sheet --view three-quarter -o kate.png",
                 [&call, flags] { render(call, *flags); });
    verb->add_option("input", flags->input,
                     "a head (.glb .gltf .fbx .obj .off .ply), moving or not, a rig file, a take or a face animation "
                     "table (.fat .bt .json)")
        ->required();
    verb->add_option("--take", flags->take,
                     "for a rig file: the motion of its own points, as mien retarget writes it; for a table: its "
                     "parameters (.fap .fba)");
    verb->add_option("-o,--output", flags->output, "what to write: .png, .mp4, .webm, or a folder for .png frames")
        ->required()
        ->check(CLI::Validator(check_extension, ""));
    add_look_flags(*verb, flags->look);
    verb->add_option("--time", flags->time, "the moment of a single picture, in seconds")->capture_default_str();
    verb->add_option("--fps", flags->fps, "frames per second of a video or folder")
        ->check(CLI::Range(0.1, 1000.0))
        ->capture_default_str();
    verb->add_flag("--sheet", flags->sheet, "a sheet of the moments that show most of the motion");
    verb->add_option("--pictures", flags->pictures, "most moments on a sheet")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    verb->add_option("--title", flags->title, "above a sheet");
    verb->add_option("--weights", flags->paint.weights,
                     "paint how far this feature point moves each vertex (rig files)");
    verb->add_option("--error", flags->paint.truth, "paint the distance to this other animation of the same head");
    verb->add_option("--error-max", flags->paint.error_max, "percent of the head's height at the end of that scale")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    verb->add_option("--compare", flags->compare, "draw this one beside it; may be given several times");
}

}  // namespace mien::cli
