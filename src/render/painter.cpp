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

constexpr int scale_unit = 4, shadow_unit = 5, facts_unit = 6;
// From so many triangles on, a surface's light in a draft is worked out at its vertices.
constexpr std::uint32_t many_triangles = 2000;

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

struct Painter::Part {
    const Instance* model;
    const Piece* piece;
    double depth;
};

struct Painter::Shot {
    std::span<const Instance* const> models;
    const Camera& camera;
    const Look& look;
    Ball all;  // round everything, from the camera's target
    std::vector<Lamp> lamps;
    std::vector<Part> one_colour;  // solid, of many triangles
    std::vector<Part> fine;        // the same with a picture or paint
    std::vector<Part> coarse;      // solid, of few triangles
    std::vector<Part> special;     // solid, with light of its own or under tears
    std::vector<Part> clear;       // see-through, from the farthest to the nearest
};

Painter::Painter()
    : one_colour_(shaders::quick_vertex(true), shaders::quick_fragment(true)),
      quick_(shaders::quick_vertex(false), shaders::quick_fragment(false)),
      draft_(shaders::surface_vertex(), shaders::surface_fragment(false)),
      facts_(shaders::surface_vertex(), shaders::facts_fragment()),
      deferred_(shaders::cover_vertex, shaders::deferred_fragment()),
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
    for (GlProgram* program : {&one_colour_, &quick_, &draft_, &facts_, &deferred_, &full_}) {
        program->use();
        int unit = 0;
        for (const char* name : {"colour_picture", "roughness_picture", "normal_picture", "emission_picture", "scale",
                                 "shadow_map", "base_facts", "normal_facts", "scatter_facts", "depth_facts"})
            program->set(name, unit++);
    }
}

void Painter::cover(GlProgram& program) {
    program.use();
    glDisable(GL_CULL_FACE);
    glBindVertexArray(nothing_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

namespace {

void set_material(GlProgram& program, const StillModel& still, const Piece& piece) {
    const Material& material = still.materials[piece.material];
    program.set("colour", material.colour);
    program.set("metallic", material.metallic);
    program.set("roughness", material.roughness);
    program.set("normal_scale", material.normal_scale);
    program.set("cutoff", material.alpha_cutoff);
    program.set("emission", material.emission);
    program.set("scatter", material.scatter);
    program.set("unlit", material.unlit ? 1 : 0);
    program.set("double_sided", material.double_sided ? 1 : 0);
    program.set("wet", piece.wet ? 1 : 0);
    std::array<float, 4> there{};
    for (std::size_t use = 0; use < there.size(); ++use) {
        const auto picture = still.pictures_of[piece.material][use];
        if (picture) bind_texture(static_cast<int>(use), still.pictures[*picture].name());
        there[use] = picture ? 1.0F : 0.0F;
    }
    program.set("pictures", there);
}

void draw_triangles(const Instance& model, const Piece& piece) {
    if (model.still->materials[piece.material].double_sided)
        glDisable(GL_CULL_FACE);
    else
        glEnable(GL_CULL_FACE);
    // The picture is drawn upside down, which turns the sides of all triangles over.
    glFrontFace(determinant(model.place) < 0 ? GL_CCW : GL_CW);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(piece.index_count), GL_UNSIGNED_INT,
                   buffer_offset(piece.first_index * sizeof(std::uint32_t)));
}

// How far red light goes under skin, in the scene's unit. A head of unknown size is taken to be 240 mm high.
double scatter_path(const Instance& model) {
    const double height = model.rest.high.y - model.rest.low.y;
    const double millimetre = model.still->millimetre > 0 ? model.still->millimetre : height / 240;
    return 3.7 * millimetre * length(model.place.columns[1]);
}

std::array<float, 3> numbers(const Rgb& colour, double times) {
    const auto t = static_cast<float>(times);
    return {t * colour[0], t * colour[1], t * colour[2]};
}

void set_room(GlProgram& program, const Camera& camera, const Look& look) {
    program.set("camera", numbers(camera.eye - camera.target));
    program.set("forwards", numbers(-axes_of(camera).back));
    program.set("sky", numbers(look.sky, look.exposure));
    program.set("ground", numbers(look.ground, look.exposure));
}

}  // namespace

void Painter::take_up(const Shot& shot, const Instance& model, GlProgram& program) {
    program.set("place", place_matrix(model.place, shot.camera.target));
    program.set("turn", turn_matrix(model.place));
    program.set("path", static_cast<float>(scatter_path(model)));
    program.set("painted", model.painted ? 1 : 0);
    program.set("scale_ends", std::array<float, 2>{model.low, model.high});
    bind_texture(scale_unit, (model.scale == ColourScale::heat ? heat_ : opposite_).name());
    glBindVertexArray(model.array.name());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, model.still->indices.name());
}

void Painter::draw_parts(const Shot& shot, std::span<const Part> parts, GlProgram& program, const Matrix& view) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    program.use();
    program.set("view", view);
    set_room(program, shot.camera, shot.look);
    const Instance* current = nullptr;
    for (const Part& part : parts) {
        if (part.model != current) take_up(shot, *part.model, program);
        current = part.model;
        set_material(program, *current->still, *part.piece);
        const bool mask = current->still->materials[part.piece->material].alpha == Material::Alpha::mask;
        program.set("alpha_mode", mask ? 1 : 0);
        draw_triangles(*current, *part.piece);
    }
}

// First what covers fully, so that the rest cannot hide it.
void Painter::draw_clear(const Shot& shot, GlProgram& program, const Matrix& view) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    program.use();
    program.set("view", view);
    set_room(program, shot.camera, shot.look);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    for (const Part& part : shot.clear) {
        take_up(shot, *part.model, program);
        set_material(program, *part.model->still, *part.piece);
        program.set("alpha_mode", 3);
        draw_triangles(*part.model, *part.piece);
        program.set("alpha_mode", 2);
        glEnable(GL_BLEND);
        glDepthMask(GL_FALSE);
        draw_triangles(*part.model, *part.piece);
        glDepthMask(GL_TRUE);
        glDisable(GL_BLEND);
    }
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
    const CameraAxes axes = axes_of(shot.camera);
    for (const Mark& mark : shot.look.marks) {
        const auto across = static_cast<float>(2 * mark.radius);
        mark_.set("size", std::array<float, 2>{across / static_cast<float>(shot.camera.width),
                                               across / static_cast<float>(shot.camera.height)});
        // Nearer along the line of sight by one and a half radii, so that the surface it lies on does not cut it.
        const Vec3 sight = shot.camera.eye - mark.position;
        const double depth = dot(sight, axes.back);
        const double radius = 2 * mark.radius * axes.slope_y * depth / shot.camera.height;
        const Vec3 nearer = mark.position + std::min(1.5 * radius / length(sight), 0.5) * sight;
        mark_.set("place", numbers(nearer - shot.camera.target));
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
        glDisable(GL_DEPTH_TEST);
        cover(background_);
    }
    const Matrix view = view_matrix(shot.camera, shot.all, {});
    for (GlProgram* program : {&one_colour_, &quick_, &draft_}) {
        program->use();
        set_lamps(*program, shot.lamps);
    }
    draw_parts(shot, shot.one_colour, one_colour_, view);
    draw_parts(shot, shot.fine, quick_, view);
    draw_parts(shot, shot.coarse, draft_, view);
    draw_parts(shot, shot.special, draft_, view);
    draw_clear(shot, draft_, view);
    if (shot.look.wire) draw_wire(shot, view);
    if (!shot.look.marks.empty()) draw_marks(shot, view);
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
                           buffer_offset(piece.first_index * sizeof(std::uint32_t)));
        }
    }
}

void Painter::draw_facts(const Shot& shot, const Matrix& view) {
    targets_->begin_facts();
    for (const auto* parts : {&shot.one_colour, &shot.fine, &shot.coarse}) draw_parts(shot, *parts, facts_, view);
}

namespace {

// Lines of sight through the pixels, as `view_matrix` puts them there.
void set_rays(GlProgram& program, const Camera& camera, const std::array<double, 2>& shift) {
    const CameraAxes axes = axes_of(camera);
    const Vec3 x = 2 * axes.slope_x / camera.width * axes.right, y = -2 * axes.slope_y / camera.height * axes.up;
    const double left = -0.5 * camera.width - shift[0], top = -0.5 * camera.height - shift[1];
    program.set("ray", numbers(left * x + top * y - axes.back));
    program.set("ray_x", numbers(x));
    program.set("ray_y", numbers(y));
}

}  // namespace

void Painter::draw_pass(const Shot& shot, const Pass& pass, const Matrix& view, std::size_t passes, float grain) {
    const bool dome = pass.lamp < 0;
    Lamp lamp = dome ? Lamp{pass.direction, {}, {}, {}} : shot.lamps[static_cast<std::size_t>(pass.lamp)];
    lamp.light = pass.light;
    // The room's reflection is shared out among the dome's passes.
    const std::uint32_t dome_passes = shot.look.passes / 2;
    const double times = dome ? static_cast<double>(passes) / dome_passes : 0;
    const std::array<Lamp, 2> lamps{lamp, Lamp{{}, {}, {}, Vec3{times, times, times}}};
    const Ball window = shadow_window(shot.camera, shot.all);
    const ShadowView shadow = shadow_view(pass.direction, window, shot.all, Targets::shadow_size, pass.shift);
    draw_shadows(shot, shadow);
    for (GlProgram* program : {&deferred_, &full_}) {
        program->use();
        set_lamps(*program, lamps);
        program->set("dome", dome ? 1 : 0);
        program->set("sample_at", numbers(pass.direction));
        program->set("shadow", shadow.lookup);
        program->set("shadow_size", numbers(Vec3{shadow.texel, shadow.depth, 1.0 / Targets::shadow_size}));
        program->set("grain", grain);
    }
    bind_texture(shadow_unit, targets_->shadow_map());
    targets_->begin_pass();
    for (std::size_t i = 0; i < 4; ++i) bind_texture(facts_unit + static_cast<int>(i), targets_->fact(i));
    deferred_.use();
    set_room(deferred_, shot.camera, shot.look);
    set_rays(deferred_, shot.camera, pass.shift);
    // The covering triangle lies at the far end: only where something is nearer, pixels are worked out.
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    cover(deferred_);
    glDepthMask(GL_TRUE);
    draw_parts(shot, shot.special, full_, view);
    draw_clear(shot, full_, view);
    if (shot.look.wire) draw_wire(shot, view);
    if (!shot.look.marks.empty()) draw_marks(shot, view);
}

void Painter::draw_full(const Shot& shot) {
    const std::vector<Pass> passes = passes_of(shot.look, shot.camera, shot.lamps);
    targets_->begin_sum();
    Matrix view{};
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (i == 0 || passes[i].shift != passes[i - 1].shift) {
            view = view_matrix(shot.camera, shot.all, passes[i].shift);
            draw_facts(shot, view);
        }
        draw_pass(shot, passes[i], view, passes.size(), static_cast<float>(i) * 0.618034F);
        targets_->begin_adding();
        add_.use();
        bind_texture(0, targets_->pass_picture());
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        glDisable(GL_DEPTH_TEST);
        cover(add_);
        glDisable(GL_BLEND);
    }
    targets_->begin_developing();
    glDisable(GL_DEPTH_TEST);
    bind_texture(0, targets_->sum_picture());
    develop_.use();
    develop_.set("share", 1.0F / static_cast<float>(passes.size()));
    develop_.set("top", shot.look.top);
    develop_.set("bottom", shot.look.bottom);
    develop_.set("transparent", shot.look.transparent ? 1 : 0);
    cover(develop_);
}

namespace {

bool is_special(const Instance& model, const Piece& piece) {
    const Material& material = model.still->materials[piece.material];
    return piece.wet || material.unlit || material.emission != std::array<float, 3>{};
}

bool is_coarse(const Instance& model, const Piece& piece) {
    const auto& pictures = model.still->pictures_of[piece.material];
    return piece.index_count < 3 * many_triangles || pictures[1] || pictures[2];
}

bool is_one_colour(const Instance& model, const Piece& piece) {
    return !model.painted && !model.still->pictures_of[piece.material][0] &&
           model.still->materials[piece.material].alpha == Material::Alpha::opaque;
}

}  // namespace

void Painter::sort_parts(Shot& shot) {
    const Vec3 back = axes_of(shot.camera).back;
    for (const Instance* model : shot.models)
        for (std::size_t p = 0; p < model->still->pieces.size(); ++p) {
            const Piece& piece = model->still->pieces[p];
            std::vector<Part>& parts = is_blend(*model, piece)        ? shot.clear
                                       : is_special(*model, piece)    ? shot.special
                                       : is_coarse(*model, piece)     ? shot.coarse
                                       : is_one_colour(*model, piece) ? shot.one_colour
                                                                      : shot.fine;
            parts.push_back({model, &piece, dot(back, moved(model->place, model->centres[p]))});
        }
    std::stable_sort(shot.clear.begin(), shot.clear.end(),
                     [](const Part& a, const Part& b) { return a.depth < b.depth; });
}

Picture Painter::draw(std::span<const Instance* const> models, const Camera& camera, const Look& look) {
    Shot shot{models, camera, look, ball_of(*models.front(), camera.target), lamps_of(look, camera), {}, {},
              {},     {},     {}};
    for (const Instance* model : models) shot.all = joined(shot.all, ball_of(*model, camera.target));
    sort_parts(shot);
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
