// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "stage.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <utility>

#include "mien/error.hpp"

namespace mien::cli {

namespace {

const std::map<std::string, View> views{
    {"front", View::front}, {"side", View::side}, {"three-quarter", View::three_quarter}};
const std::map<std::string, Quality> qualities{{"draft", Quality::draft}, {"full", Quality::full}};

const Vec3* find(const std::vector<NamedPlace>& places, std::string_view name) {
    const auto found =
        std::find_if(places.begin(), places.end(), [&](const NamedPlace& place) { return place.name == name; });
    return found == places.end() ? nullptr : &found->place;
}

// The middle of what is asked for, and how much around it is shown as a share of the head's height.
struct CloseUp {
    std::vector<std::string> points;
    double share;
};

CloseUp close_up(const std::string& name) {
    if (name == "eyes") return {{"3.7", "3.11", "3.8", "3.12", "3.1", "3.3", "3.2", "3.4"}, 0.16};
    if (name == "mouth") return {{"8.3", "8.4", "8.1", "8.2"}, 0.14};
    return {{name}, 0.14};
}

Box around(const CloseUp& wanted, const std::vector<NamedPlace>& places, double height, const std::string& actor) {
    Vec3 sum;
    double count = 0;
    for (const std::string& name : wanted.points)
        if (const Vec3* place = find(places, name)) sum += *place, count += 1;
    if (count == 0)
        throw Error(
            fmt::format("{}: expected one of the feature points {} to look at, found none; a rig file or an "
                        "animated head written by mien has them",
                        actor, fmt::join(wanted.points, " ")));
    const double r = wanted.share * height;
    return {sum / count - Vec3{r, r, 0}, sum / count + Vec3{r, r, 0}};
}

// The box round the points; of the whole head where there are none.
Box box_of(const std::vector<NamedPlace>& places, const Box& whole) {
    std::vector<Vec3> points;
    points.reserve(places.size());
    for (const NamedPlace& place : places) points.push_back(place.place);
    return points.empty() ? whole : bounding_box(points);
}

Picture with_points(Picture picture, const std::vector<NamedPlace>& places, const Camera& camera) {
    std::vector<Vec2f> at;
    std::vector<std::string> names;
    for (const NamedPlace& place : places)
        if (const auto seen = project(camera, place.place)) {
            at.push_back({static_cast<float>(seen->x), static_cast<float>(seen->y)});
            names.push_back(place.name);
        }
    draw_points(picture, at, names);
    return picture;
}

}  // namespace

Size size_of(const std::string& text, Size wanted) {
    if (text.empty()) return wanted;
    Size size;
    const char* end = text.data() + text.size();
    const auto [x, first] = std::from_chars(text.data(), end, size.width);
    const bool crossed = first == std::errc() && x != end && *x == 'x';
    const auto [last, second] = crossed ? std::from_chars(x + 1, end, size.height) : std::from_chars_result{x, first};
    if (!crossed || second != std::errc() || last != end || size.width == 0 || size.height == 0)
        throw Error(fmt::format("--size: expected width x height such as 640x480, found {}", text));
    return size;
}

void add_picture_flags(CLI::App& verb, LookFlags& flags) {
    verb.add_option("--size", flags.size, "of a picture in pixels, such as 640x480");
    verb.add_option("--view", flags.view, "where the camera stands")
        ->transform(CLI::CheckedTransformer(views).description("front, side or three-quarter"))
        ->default_str("front");
    verb.add_option("--quality", flags.quality, "full: soft shadows and light under the skin; draft: fast")
        ->transform(CLI::CheckedTransformer(qualities).description("draft or full"))
        ->default_str("full");
    verb.add_option("--passes", flags.passes, "of full quality: more is smoother and takes longer")
        ->check(CLI::Range(8, 1024));
    verb.add_flag("--wire", flags.wire, "draw the edges of the triangles too");
    verb.add_flag("--software", flags.software, "draw on the processor even where there is a graphics card");
}

void add_look_flags(CLI::App& verb, LookFlags& flags) {
    add_picture_flags(verb, flags);
    verb.add_option("--close-up", flags.close_up, "look at eyes, mouth, all points or one feature point from near");
    verb.add_flag("--points", flags.points, "mark the feature points with their ids");
}

Stage::Stage(const LookFlags& look, const PaintFlags& paint, Size size)
    : flags_(look), paint_(paint), size_(size), renderer_(RendererOptions{look.software}) {}

Camera Stage::camera(const Actor& actor, ModelId model) {
    const Box rest = renderer_.rest_box(model), box = reach(renderer_, model, actor);
    if (flags_.close_up == "points")
        return frame(box_of(points_at(actor, flags_.time), box), flags_.view, size_.width, size_.height, 0.12);
    if (flags_.close_up.empty()) return frame(box, flags_.view, size_.width, size_.height);
    const Box near =
        around(close_up(flags_.close_up), points_at(actor, flags_.time), rest.high.y - rest.low.y, actor.name);
    return frame(near, flags_.view, size_.width, size_.height, 0);
}

void Stage::enter(Actor actor) {
    const ModelId model = upload(renderer_, actor);
    cameras_.push_back(camera(actor, model));
    models_.push_back(model);
    actors_.push_back(std::move(actor));
    if (!paint_.weights.empty()) paint_weights(actors_.size() - 1);
}

void Stage::look(const LookFlags& flags) {
    flags_ = flags;
    for (std::size_t i = 0; i < actors_.size(); ++i) cameras_[i] = camera(actors_[i], models_[i]);
}

void Stage::show_weights(const std::string& point) {
    paint_.weights = point;
    for (std::size_t i = 0; i < actors_.size(); ++i)
        if (point.empty())
            renderer_.paint(models_[i], {});
        else
            paint_weights(i);
}

void Stage::set_truth(Actor actor) {
    truth_model_ = upload(renderer_, actor);
    for (std::size_t i = 0; i < models_.size(); ++i)
        if (renderer_.vertex_count(models_[i]) != renderer_.vertex_count(truth_model_))
            throw Error(fmt::format("{}: expected the {} vertices of {} to measure the distance to, found {}",
                                    actor.name, renderer_.vertex_count(models_[i]), actors_[i].name,
                                    renderer_.vertex_count(truth_model_)));
    truth_ = std::move(actor);
}

double Stage::seconds() const {
    double longest = 0;
    for (const Actor& actor : actors_) longest = std::max(longest, actor.seconds);
    return longest;
}

std::optional<Legend> Stage::legend() const {
    Legend legend;
    if (!paint_.weights.empty()) {
        legend.low = -1;
        legend.unit = fmt::format("weight of {}", paint_.weights);
        legend.scale = ColourScale::opposite;
    } else if (truth_) {
        legend.high = paint_.error_max;
        legend.unit = fmt::format("% of the height from {}", truth_->name);
    } else {
        return std::nullopt;
    }
    return legend;
}

std::vector<double> Stage::key_times(std::size_t count) {
    const auto longest = std::max_element(actors_.begin(), actors_.end(),
                                          [](const Actor& a, const Actor& b) { return a.seconds < b.seconds; });
    const auto i = static_cast<std::size_t>(longest - actors_.begin());
    return cli::key_times(renderer_, models_[i], actors_[i], count);
}

void Stage::paint_weights(std::size_t i) {
    const Actor& actor = actors_[i];
    const auto point = actor.rig ? find_point(actor.rig->points, paint_.weights) : std::nullopt;
    if (!point)
        throw Error(fmt::format("{}: expected a rig file with the feature point {}, found {}", actor.name,
                                paint_.weights, actor.rig ? "a rig without it" : "no rig"));
    const std::vector<float> all = weights_of(*actor.rig, *point);
    std::vector<float> values;
    for (const Surface& surface : actor.scene.surfaces)
        for (const std::uint32_t v : surface.mesh_vertices) values.push_back(all[v]);
    renderer_.paint(models_[i], {values, -1, 1, ColourScale::opposite});
}

void Stage::paint_error(std::size_t i) {
    const std::size_t count = renderer_.vertex_count(models_[i]);
    std::vector<Vec3f> found(count), expected(count);
    renderer_.read_positions(models_[i], found);
    renderer_.read_positions(truth_model_, expected);
    const Box box = renderer_.rest_box(truth_model_);
    std::vector<float> values(count);
    for (std::size_t v = 0; v < count; ++v)
        values[v] = 100 * distance(found[v], expected[v]) / static_cast<float>(box.high.y - box.low.y);
    renderer_.paint(models_[i], {values, 0, static_cast<float>(paint_.error_max), ColourScale::heat});
}

Picture Stage::picture(std::size_t i, double time) {
    pose(renderer_, models_[i], actors_[i], time);
    if (truth_) {
        pose(renderer_, truth_model_, *truth_, time);
        paint_error(i);
    }
    Look look;
    look.quality = flags_.quality;
    if (flags_.passes > 0) look.passes = flags_.passes;
    look.wire = flags_.wire;
    Picture picture = renderer_.draw(std::array{models_[i]}, cameras_[i], look);
    return flags_.points ? with_points(std::move(picture), points_at(actors_[i], time), cameras_[i]) : picture;
}

}  // namespace mien::cli
