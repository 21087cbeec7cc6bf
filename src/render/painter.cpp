// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "render/painter.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "render/pictures.hpp"
#include "render/shaders.hpp"

namespace mien {

namespace {

constexpr int scale_unit = 4, shadow_unit = 5;
constexpr std::size_t most_lamps = 8;

std::array<float, 3> numbers(const Vec3& v) {
    const Vec3f f = to_float(v);
    return {f.x, f.y, f.z};
}

// The ball round a model in its place, with room for its motion.
Ball ball_of(const Instance& model, const Vec3& origin) {
    const Vec3 half = 0.5 * (model.rest.high - model.rest.low);
    Ball ball{moved(model.place, 0.5 * (model.rest.low + model.rest.high)) - origin, 0};
    for (const double x : {-half.x, half.x})
        for (const double y : {-half.y, half.y})
            ball.radius = std::max(ball.radius, 1.25 * length(turned(model.place, {x, y, half.z})));
    return ball;
}

// A ball round both.
Ball joined(const Ball& a, const Ball& b) {
    const double apart = distance(a.centre, b.centre);
    if (apart + b.radius <= a.radius) return a;
    if (apart + a.radius <= b.radius) return b;
    const double radius = 0.5 * (apart + a.radius + b.radius);
    return {a.centre + (radius - a.radius) / apart * (b.centre - a.centre), radius};
}

bool is_blend(const Instance& model, const Piece& piece) {
    return model.still->materials[piece.material].alpha == Material::Alpha::blend;
}

void set_lamps(GlProgram& program, std::span<const Lamp> lamps) {
    std::vector<std::array<float, 3>> directions, across, upward, light;
    for (const Lamp& lamp : lamps) {
        directions.push_back(numbers(lamp.direction));
        across.push_back(numbers(lamp.across));
        upward.push_back(numbers(lamp.upward));
        light.push_back(numbers(lamp.light));
    }
    program.set("lamps", static_cast<int>(lamps.size()));
    program.set("lamp", directions);
    program.set("across", across);
    program.set("upward", upward);
    program.set("light", light);
}

// Colours of a draft with transparent parts come premultiplied; pictures have them plain.
void divide_by_alpha(Picture& picture) {
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        const unsigned alpha = picture.rgba[i + 3];
        for (std::size_t c = i; c < i + 3 && alpha > 0; ++c)
            picture.rgba[c] = static_cast<std::uint8_t>(std::min(255U, (255U * picture.rgba[c] + alpha / 2) / alpha));
    }
}

}  // namespace

struct Painter::Shot {
    struct Part {
        const Instance* model;
        const Piece* piece;
        double depth;
    };
    std::span<const Instance* const> models;
    const Camera& camera;
    const Look& look;
    Ball all;  // round everything, from the camera's target
    std::vector<Lamp> lamps;
    std::vector<Part> solid, clear;  // `clear`: from the farthest to the nearest
};

Painter::Painter()
    : draft_(shaders::surface_vertex(), shaders::surface_fragment(false)),
      full_(shaders::surface_vertex(), shaders::surface_fragment(true)),
      shadow_(shaders::shadow_vertex, shaders::shadow_fragment),
      wire_(shaders::wire_vertex, shaders::wire_fragment),
      mark_(shaders::mark_vertex, shaders::mark_fragment),
      background_(shaders::cover_vertex, shaders::background_fragment),
      add_(shaders::cover_vertex, shaders::add_fragment),
      develop_(shaders::cover_vertex, shaders::develop_fragment),
      heat_(scale_picture(ColourScale::heat)),
      opposite_(scale_picture(ColourScale::opposite)),
      nothing_(GlName::Kind::vertex_array) {
    for (GlProgram* program : {&draft_, &full_}) {
        program->use();
        int unit = 0;
        for (const char* name : {"colour_picture", "roughness_picture", "normal_picture", "emission_picture", "scale"})
            program->set(name, unit++);
        program->set("shadow_map", shadow_unit);
    }
}

void Painter::cover(GlProgram& program) {
    program.use();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(nothing_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Painter::draw_piece(GlProgram& program, const Instance& model, const Piece& piece, int alpha_mode) {
    const StillModel& still = *model.still;
    const Material& material = still.materials[piece.material];
    program.set("colour", material.colour);
    program.set("metallic", material.metallic);
    program.set("roughness", material.roughness);
    program.set("normal_scale", material.normal_scale);
    program.set("cutoff", material.alpha_cutoff);
    program.set("emission", material.emission);
    program.set("scatter", material.scatter);
    program.set("alpha_mode", alpha_mode);
    program.set("unlit", material.unlit ? 1 : 0);
    program.set("wet", piece.wet ? 1 : 0);
    std::array<float, 4> there{};
    for (std::size_t use = 0; use < there.size(); ++use) {
        const auto picture = still.pictures_of[piece.material][use];
        if (picture) bind_texture(static_cast<int>(use), still.pictures[*picture].name());
        there[use] = picture ? 1.0F : 0.0F;
    }
    program.set("pictures", there);
    if (material.double_sided)
        glDisable(GL_CULL_FACE);
    else
        glEnable(GL_CULL_FACE);
    // The picture is drawn upside down, which turns the sides of all triangles over.
    glFrontFace(determinant(model.place) < 0 ? GL_CCW : GL_CW);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(piece.index_count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(piece.first_index * sizeof(std::uint32_t)));
}

void Painter::draw_everything(const Shot& shot, GlProgram& program, const Matrix& view) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    program.use();
    program.set("view", view);
    program.set("camera", numbers(shot.camera.eye - shot.camera.target));
    program.set("sky", numbers(shot.look.exposure * Vec3{shot.look.sky[0], shot.look.sky[1], shot.look.sky[2]}));
    program.set("ground",
                numbers(shot.look.exposure * Vec3{shot.look.ground[0], shot.look.ground[1], shot.look.ground[2]}));
    const Instance* current = nullptr;
    const auto take_up = [&](const Instance& model) {
        if (current == &model) return;
        current = &model;
        program.set("place", place_matrix(model.place, shot.camera.target));
        program.set("turn", turn_matrix(model.place));
        const double height = model.rest.high.y - model.rest.low.y;
        const double size = length(model.place.columns[1]);
        program.set("path", static_cast<float>(3.7 * size *
                                               (model.still->millimetre > 0 ? model.still->millimetre : height / 240)));
        program.set("painted", model.painted ? 1 : 0);
        program.set("scale_ends", std::array<float, 2>{model.low, model.high});
        bind_texture(scale_unit, (model.scale == ColourScale::heat ? heat_ : opposite_).name());
        glBindVertexArray(model.array.name());
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, model.still->indices.name());
    };
    for (const Shot::Part& part : shot.solid) {
        take_up(*part.model);
        const bool mask = part.model->still->materials[part.piece->material].alpha == Material::Alpha::mask;
        draw_piece(program, *part.model, *part.piece, mask ? 1 : 0);
    }
    for (const Shot::Part& part : shot.clear) {
        take_up(*part.model);
        draw_piece(program, *part.model, *part.piece, 3);
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        glDepthMask(GL_FALSE);
        draw_piece(program, *part.model, *part.piece, 2);
        glDepthMask(GL_TRUE);
        glDisable(GL_BLEND);
    }
    if (shot.look.wire) draw_wire(shot, view);
    if (!shot.look.marks.empty()) draw_marks(shot, view);
}

void Painter::draw_wire(const Shot& shot, const Matrix& view) {
    wire_.use();
    wire_.set("view", view);
    wire_.set("colour", std::array<float, 4>{0.01F, 0.015F, 0.02F, 0.6F});
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    for (const Instance* model : shot.models) {
        wire_.set("place", place_matrix(model->place, shot.camera.target));
        glBindVertexArray(model->array.name());
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, model->still->edges.name());
        glDrawElements(GL_LINES, model->still->edge_count, GL_UNSIGNED_INT, nullptr);
    }
    glDisable(GL_BLEND);
}

void Painter::draw_marks(const Shot& shot, const Matrix& view) {
    mark_.use();
    mark_.set("view", view);
    mark_.set("full", shot.look.quality == Quality::full ? 1 : 0);
    glBindVertexArray(nothing_.name());
    glDisable(GL_CULL_FACE);
    for (const Mark& mark : shot.look.marks) {
        const auto across = static_cast<float>(2 * mark.radius);
        mark_.set("size", std::array<float, 2>{across / static_cast<float>(shot.camera.width),
                                               across / static_cast<float>(shot.camera.height)});
        mark_.set("place", numbers(mark.position - shot.camera.target));
        mark_.set("colour", mark.colour);
        if (mark.always_on_top) glDisable(GL_DEPTH_TEST);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        glEnable(GL_DEPTH_TEST);
    }
}

void Painter::draw_draft(const Shot& shot) {
    targets_->begin_draft();
    if (!shot.look.transparent) {
        background_.use();
        background_.set("top", shot.look.top);
        background_.set("bottom", shot.look.bottom);
        cover(background_);
    }
    draft_.use();
    set_lamps(draft_, shot.lamps);
    draw_everything(shot, draft_, view_matrix(shot.camera, shot.all, {}));
    targets_->end_draft();
}

void Painter::draw_shadows(const Shot& shot, const ShadowView& shadow) {
    targets_->begin_shadow();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDisable(GL_CULL_FACE);
    shadow_.use();
    shadow_.set("view", shadow.view);
    for (const Instance* model : shot.models) {
        shadow_.set("place", place_matrix(model->place, shot.camera.target));
        glBindVertexArray(model->array.name());
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, model->still->indices.name());
        for (const Piece& piece : model->still->pieces) {
            const Material& material = model->still->materials[piece.material];
            const bool solid = material.alpha == Material::Alpha::opaque;
            const auto picture = model->still->pictures_of[piece.material][0];
            const float cutoff = material.alpha == Material::Alpha::mask ? material.alpha_cutoff : 0.5F;
            if (!solid && !picture && material.colour[3] < cutoff) continue;
            const bool pictured = !solid && picture.has_value();
            shadow_.set("pictured", pictured ? 1 : 0);
            shadow_.set("alpha", material.colour[3]);
            shadow_.set("cutoff", cutoff);
            if (pictured) bind_texture(0, model->still->pictures[*picture].name());
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(piece.index_count), GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(piece.first_index * sizeof(std::uint32_t)));
        }
    }
}

void Painter::draw_full(const Shot& shot) {
    const std::vector<Pass> passes = passes_of(shot.look, shot.camera, shot.lamps);
    const Ball window = shadow_window(shot.camera, shot.all);
    targets_->begin_sum();
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const Pass& pass = passes[i];
        const ShadowView shadow = shadow_view(pass.direction, window, shot.all, Targets::shadow_size, pass.shift);
        draw_shadows(shot, shadow);
        targets_->begin_pass();
        full_.use();
        const bool dome = pass.lamp < 0;
        Lamp lamp = dome ? Lamp{pass.direction, {}, {}, {}} : shot.lamps[static_cast<std::size_t>(pass.lamp)];
        lamp.light = pass.light;
        const double dome_passes = static_cast<double>(shot.look.passes / 2);
        const double times = dome ? static_cast<double>(passes.size()) / dome_passes : 0;
        set_lamps(full_, std::array<Lamp, 2>{lamp, Lamp{{}, {}, {}, Vec3{times, times, times}}});
        full_.set("dome", dome ? 1 : 0);
        full_.set("sample_at", numbers(pass.direction));
        full_.set("shadow", shadow.lookup);
        full_.set("shadow_size", numbers(Vec3{shadow.texel, shadow.depth, 1.0 / Targets::shadow_size}));
        full_.set("grain", static_cast<float>(i) * 0.618034F);
        bind_texture(shadow_unit, targets_->shadow_map());
        draw_everything(shot, full_, view_matrix(shot.camera, shot.all, pass.shift));
        targets_->begin_adding();
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        bind_texture(0, targets_->pass_picture());
        cover(add_);
        glDisable(GL_BLEND);
    }
    targets_->begin_developing();
    bind_texture(0, targets_->sum_picture());
    develop_.use();
    develop_.set("share", 1.0F / static_cast<float>(passes.size()));
    develop_.set("top", shot.look.top);
    develop_.set("bottom", shot.look.bottom);
    develop_.set("transparent", shot.look.transparent ? 1 : 0);
    cover(develop_);
}

Picture Painter::draw(std::span<const Instance* const> models, const Camera& camera, const Look& look) {
    Shot shot{models, camera, look, ball_of(*models.front(), camera.target), lamps_of(look, camera), {}, {}};
    const Vec3 back = axes_of(camera).back;
    for (const Instance* model : models) {
        shot.all = joined(shot.all, ball_of(*model, camera.target));
        for (std::size_t p = 0; p < model->still->pieces.size(); ++p) {
            const Piece& piece = model->still->pieces[p];
            const double depth = dot(back, moved(model->place, model->centres[p]));
            (is_blend(*model, piece) ? shot.clear : shot.solid).push_back({model, &piece, depth});
        }
    }
    std::stable_sort(shot.clear.begin(), shot.clear.end(),
                     [](const Shot::Part& a, const Shot::Part& b) { return a.depth < b.depth; });
    if (!targets_ || !targets_->fits(camera.width, camera.height)) {
        targets_.reset();
        targets_.emplace(camera.width, camera.height);
    }
    if (look.quality == Quality::draft)
        draw_draft(shot);
    else
        draw_full(shot);
    Picture picture = targets_->read();
    if (look.quality == Quality::draft && look.transparent) divide_by_alpha(picture);
    check_gl("a picture");
    return picture;
}

}  // namespace mien
