// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "rig_picture.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

#include "stage.hpp"

#include "mien/draw/sheet.hpp"

namespace mien::cli {

namespace {

constexpr std::size_t most_points = 10;

// Points whose influence tells most about a rig come first: chin, lips, cheeks, lids, brows, nose; then any.
std::vector<std::string> telling_points(const Rig& rig) {
    std::vector<std::string> chosen;
    for (const char* id : {"2.1", "2.10", "8.1", "8.2", "8.3", "5.3", "3.1", "3.3", "4.1", "4.3", "9.3", "9.1"})
        if (find_point(rig.points, id)) chosen.emplace_back(id);
    for (const FeaturePoint& point : rig.points)
        if (std::find(chosen.begin(), chosen.end(), point.id) == chosen.end()) chosen.push_back(point.id);
    chosen.resize(std::min(chosen.size(), most_points));
    return chosen;
}

}  // namespace

Picture rig_picture(const std::string& name, const Mesh& mesh, const Rig& rig) {
    LookFlags look;
    look.points = true;
    look.close_up = "points";
    look.passes = 24;
    Stage stage(look, {}, {360, 440});
    stage.enter(actor_of(name, mesh, rig));
    std::vector<Picture> pictures{stage.picture(0, 0)};
    look.view = View::side;
    stage.look(look);
    pictures.push_back(stage.picture(0, 0));
    std::vector<std::string> captions{"feature points", "from the side"};

    look.view = View::front;
    look.points = false;
    look.close_up.clear();
    stage.look(look);
    for (const std::string& point : telling_points(rig)) {
        stage.show_weights(point);
        pictures.push_back(stage.picture(0, 0));
        captions.push_back("weight of " + point);
    }
    SheetOptions options;
    options.columns = 4;
    options.title = name;
    options.note = fmt::format("{}, {} feature points", rig.method, rig.points.size());
    options.legend = Legend{.low = -1, .high = 1, .unit = "weight", .scale = ColourScale::opposite};
    return contact_sheet(pictures, captions, options);
}

}  // namespace mien::cli
