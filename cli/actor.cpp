// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "actor.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "fap_files.hpp"
#include "inputs.hpp"

#include "mien/algorithms/bake_fat.hpp"
#include "mien/algorithms/complete.hpp"
#include "mien/algorithms/key_rows.hpp"
#include "mien/algorithms/resolve_faps.hpp"
#include "mien/algorithms/tracks.hpp"
#include "mien/error.hpp"
#include "mien/face.hpp"
#include "mien/io/gltf.hpp"
#include "mien/io/read.hpp"
#include "mien/io/scene.hpp"
#include "mien/render/dress.hpp"
#include "mien/render/take_scene.hpp"

namespace mien::cli {

namespace fs = std::filesystem;

namespace {

void play(Actor& actor, const Mesh& mesh, const fs::path& take, Report& report) {
    const Take target = read_take(take);
    const TakeBinding binding = bind_take(*actor.rig, target);
    report["points_carried_by_the_skin"] = binding.missing;
    report["columns_not_used"] = binding.unused;
    actor.take = complete({mesh, actor.rig->points}, target);
    actor.binding = bind_take(*actor.rig, actor.take);
    actor.seconds = actor.take.times.empty() ? 0 : actor.take.times.back();
}

std::vector<Vec3f> displacements_at(const Actor& actor, double time) {
    std::vector<Vec3f> moves(actor.rig->points.size());
    if (row_count(actor.take) > 0) displacements(*actor.rig, actor.binding, frame_at(actor.take, time).points, moves);
    return moves;
}

Movement movement(const Actor& actor) {
    return {actor.rig ? &*actor.rig : nullptr, {}};
}

// How far apart pictures may be, and of how many vertices, when motion is looked at to choose from it.
constexpr std::size_t most_times = 240, most_vertices = 500;

// A face animation table plays as the morph targets that say the same.
Actor tabled(const fs::path& file, const fs::path& faps, Report& report) {
    const Fdp fdp = read_fdp(file);
    const FapStream stream = faps.empty() ? FapStream{} : resolve_faps(load_faps(faps, report), fdp.fat);
    Actor actor;
    actor.name = file.stem().string();
    actor.scene = parse_scene(format_glb(fdp.mesh, fat_morphs(fdp.fat, fdp.mesh, stream)), {});
    actor.seconds = duration(actor.scene);
    dress(actor.scene, nullptr);
    report["file"] = file.filename().string();
    report["vertices"] = vertex_count(fdp.mesh);
    report["seconds"] = actor.seconds;
    return actor;
}

Actor captured(const fs::path& file, Report& report) {
    Actor actor;
    actor.name = file.stem().string();
    const Take take = drop_never_seen(read_take(file));
    actor.scene = scene_of(take);
    actor.seconds = duration(actor.scene);
    report["file"] = file.filename().string();
    report["points"] = take.points.size();
    report["seconds"] = actor.seconds;
    return actor;
}

}  // namespace

Actor actor_of(const std::string& name, const Mesh& mesh, std::optional<Rig> rig) {
    Actor actor;
    actor.name = name;
    actor.rig = std::move(rig);
    actor.scene = scene_of(mesh);
    if (!actor.rig) actor.seconds = duration(actor.scene);
    dress(actor.scene, actor.rig ? &*actor.rig : nullptr);
    return actor;
}

Actor load_actor(const fs::path& file, const fs::path& take, Report& report) {
    if (is_take(file)) return captured(file, report);
    if (is_fdp(file)) return tabled(file, take, report);
    const Mesh mesh = read_mesh(file);
    const bool rigged = is_rig(mesh);
    if (!rigged && !take.empty())
        throw Error(fmt::format("{}: expected a rig file to play a take on, as mien rig writes it; found another file",
                                file.string()));
    Actor actor = actor_of(file.stem().string(), mesh, rigged ? std::optional(read_rig(file).rig) : std::nullopt);
    if (!take.empty()) play(actor, mesh, take, report);
    report["file"] = file.filename().string();
    report["vertices"] = vertex_count(mesh);
    report["seconds"] = actor.seconds;
    if (!actor.scene.left_out.empty()) report["left_out"] = actor.scene.left_out;
    return actor;
}

ModelId upload(Renderer& renderer, const Actor& actor) {
    return actor.rig ? renderer.upload(actor.scene, movement(actor)) : renderer.upload(actor.scene);
}

void pose(Renderer& renderer, ModelId model, const Actor& actor, double time) {
    if (actor.rig)
        renderer.pose(model, displacements_at(actor, time));
    else
        renderer.pose(model, pose_at(actor.scene, time));
}

Box reach(Renderer& renderer, ModelId model, const Actor& actor) {
    constexpr int times = 24;
    const Box rest = renderer.rest_box(model);
    if (!(actor.seconds > 0)) return rest;
    std::vector<Vec3f> places(renderer.vertex_count(model));
    std::vector<Vec3> corners{rest.low, rest.high}, all(places.size());
    for (int i = 0; i < times; ++i) {
        pose(renderer, model, actor, actor.seconds * i / (times - 1));
        renderer.read_positions(model, places);
        std::transform(places.begin(), places.end(), all.begin(), [](const Vec3f& place) { return to_double(place); });
        const Box box = bounding_box(all);
        corners.insert(corners.end(), {box.low, box.high});
    }
    return bounding_box(corners);
}

std::vector<NamedPlace> points_at(const Actor& actor, double time) {
    std::vector<NamedPlace> places;
    if (actor.rig) {
        const std::vector<Vec3f> moves = displacements_at(actor, time);
        for (std::size_t i = 0; i < moves.size(); ++i)
            places.push_back({actor.rig->points[i].id, actor.rig->points[i].position + to_double(moves[i])});
        return places;
    }
    const ScenePose pose = pose_at(actor.scene, time);
    for (std::size_t i = 0; i < actor.scene.nodes.size(); ++i)
        if (!mirror_point(actor.scene.nodes[i].name).empty())
            places.push_back({actor.scene.nodes[i].name, pose.worlds[i].offset});
    return places;
}

std::vector<double> key_times(Renderer& renderer, ModelId model, const Actor& actor, std::size_t count) {
    if (!(actor.seconds > 0)) return {0};
    std::vector<Vec3f> all(renderer.vertex_count(model)), some;
    const std::size_t stride = all.size() / most_vertices + 1;
    std::vector<double> times;
    for (std::size_t i = 0; i < most_times; ++i) {
        times.push_back(actor.seconds * static_cast<double>(i) / (most_times - 1));
        pose(renderer, model, actor, times.back());
        renderer.read_positions(model, all);
        for (std::size_t v = 0; v < all.size(); v += stride) some.push_back(all[v]);
    }
    std::vector<double> chosen;
    for (const std::size_t row : key_rows(some, some.size() / times.size(), count)) chosen.push_back(times[row]);
    return chosen;
}

}  // namespace mien::cli
