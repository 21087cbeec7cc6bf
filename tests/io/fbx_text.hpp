// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

// An FBX file as text: a square of 1 m in the unit of centimetres whose shape lifts a corner, that hangs half on a
// bone, and whose node shifts; each over two seconds.

#pragma once

#include <fmt/format.h>
#include <string>
#include <string_view>

namespace mien::fbx_text {

/// What of the file tests change.
struct Square {
    std::string axes = "1, 1, 2, 1, 0, 1";  ///< up, its sign, front, its sign, right, its sign
    std::string vertices = "0,0,0,100,0,0,100,100,0,0,100,0";
    std::string corners = "0,1,2,-4";
    std::string clusters = "2,3";  ///< vertices that hang on the bone, with weight 1
    double unit = 1;               ///< centimetres
    bool skinned = false;
    bool materials = false;  ///< two triangles, each of a material of its own
    bool animated = true;
};

inline std::string settings(const Square& square) {
    std::string text = "GlobalSettings:  {\n Version: 1000\n Properties70:  {\n";
    std::string_view axes = square.axes;
    for (const char* name : {"UpAxis", "UpAxisSign", "FrontAxis", "FrontAxisSign", "CoordAxis", "CoordAxisSign"}) {
        const std::size_t comma = axes.find(',');
        text += fmt::format("  P: \"{}\", \"int\", \"Integer\", \"\",{}\n", name, axes.substr(0, comma));
        axes.remove_prefix(comma == std::string_view::npos ? axes.size() : comma + 1);
    }
    return text + fmt::format(
                      "  P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",{}\n"
                      "  P: \"TimeMode\", \"enum\", \"\", \"\",6\n }}\n}}\n",
                      square.unit);
}

inline std::string shape_objects() {
    return R"( Geometry: 2, "Geometry::lift", "Shape" {
  Version: 100
  Indexes: *1 { a: 2 }
  Vertices: *3 { a: 0,0,50 }
  Normals: *3 { a: 0,0,0 }
 }
 Deformer: 3, "Deformer::shapes", "BlendShape" { Version: 100 }
 Deformer: 4, "SubDeformer::lift", "BlendShapeChannel" {
  Version: 100
  DeformPercent: 0
  FullWeights: *1 { a: 100 }
 }
)";
}

inline std::string skin_objects(const Square& square) {
    const std::string bone = "1,0,0,0,0,1,0,0,0,0,1,0,0,100,0,1";
    return fmt::format(R"( Model: 20, "Model::bone", "LimbNode" {{
  Version: 232
  Properties70:  {{ P: "Lcl Translation", "Lcl Translation", "", "A",0,100,0 }}
 }}
 Deformer: 21, "Deformer::skin", "Skin" {{ Version: 101 }}
 Deformer: 22, "SubDeformer::bone", "Cluster" {{
  Version: 100
  Indexes: *2 {{ a: {} }}
  Weights: *2 {{ a: 1,1 }}
  Transform: *16 {{ a: 1,0,0,0,0,1,0,0,0,0,1,0,0,-100,0,1 }}
  TransformLink: *16 {{ a: {} }}
 }}
)",
                       square.clusters, bone);
}

/// One of two triangles each.
inline std::string materials_layer() {
    return R"(  LayerElementMaterial: 0 {
   Version: 101
   Name: ""
   MappingInformationType: "ByPolygon"
   ReferenceInformationType: "IndexToDirect"
   Materials: *2 { a: 0,1 }
  }
  Layer: 0 {
   Version: 100
   LayerElement:  {
    Type: "LayerElementMaterial"
    TypedIndex: 0
   }
  }
)";
}

inline std::string material_objects() {
    std::string text;
    for (const char* material : {"30, \"Material::red\"", "31, \"Material::blue\""})
        text += fmt::format(" Material: {}, \"\" {{\n  Version: 102\n  ShadingModel: \"lambert\"\n }}\n", material);
    return text;
}

/// A curve of two keys at 0 and 2 seconds.
inline std::string curve(int number, double from, double to) {
    return fmt::format(R"( AnimationCurve: {}, "AnimCurve::", "" {{
  Default: 0
  KeyVer: 4008
  KeyTime: *2 {{ a: 0,92372316000 }}
  KeyValueFloat: *2 {{ a: {},{} }}
  KeyAttrFlags: *1 {{ a: 260 }}
  KeyAttrDataFloat: *4 {{ a: 0,0,0,0 }}
  KeyAttrRefCount: *1 {{ a: 2 }}
 }}
)",
                       number, from, to);
}

inline std::string curve_node(int number, const char* name, const char* property) {
    return fmt::format(
        " AnimationCurveNode: {}, \"AnimCurveNode::{}\", \"\" {{\n  Properties70:  {{ P: \"{}\", "
        "\"Number\", \"\", \"A\",0 }}\n }}\n",
        number, name, property);
}

inline std::string animation_objects(const Square& square) {
    if (!square.animated) return "";
    std::string text =
        " AnimationStack: 10, \"AnimStack::talk\", \"\" { }\n AnimationLayer: 11, \"AnimLayer::base\", \"\" { }\n";
    text += curve_node(12, "DeformPercent", "d|DeformPercent") + curve(13, 0, 100);
    text += curve_node(14, "T", "d|X") + curve(15, 0, 300);
    if (square.skinned) text += curve_node(16, "R", "d|Z") + curve(17, 0, 90);
    return text;
}

inline std::string connections(const Square& square) {
    std::string text =
        "Connections:  {\n C: \"OO\",1,5\n C: \"OO\",5,0\n C: \"OO\",3,1\n C: \"OO\",4,3\n C: \"OO\",2,4\n";
    if (square.materials) text += " C: \"OO\",30,5\n C: \"OO\",31,5\n";
    if (square.skinned) text += " C: \"OO\",20,0\n C: \"OO\",21,1\n C: \"OO\",22,21\n C: \"OO\",20,22\n";
    if (square.animated)
        text +=
            " C: \"OO\",11,10\n C: \"OO\",12,11\n C: \"OP\",12,4, \"DeformPercent\"\n C: \"OP\",13,12, "
            "\"d|DeformPercent\"\n"
            " C: \"OO\",14,11\n C: \"OP\",14,5, \"Lcl Translation\"\n C: \"OP\",15,14, \"d|X\"\n";
    if (square.animated && square.skinned)
        text += " C: \"OO\",16,11\n C: \"OP\",16,20, \"Lcl Rotation\"\n C: \"OP\",17,16, \"d|Z\"\n";
    return text + "}\n";
}

inline std::string fbx(const Square& square = {}) {
    std::string text =
        "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n FBXHeaderVersion: 1003\n FBXVersion: 7400\n}\n";
    text += settings(square) + "Definitions:  {\n Version: 100\n Count: 0\n}\nObjects:  {\n";
    const std::string corners = square.materials ? "*6 { a: 0,1,-3,0,2,-4 }" : "*4 { a: " + square.corners + " }";
    text += fmt::format(
        " Geometry: 1, \"Geometry::face\", \"Mesh\" {{\n  Vertices: *12 {{ a: {} }}\n"
        "  PolygonVertexIndex: {}\n  GeometryVersion: 124\n{} }}\n",
        square.vertices, corners, square.materials ? materials_layer() : "");
    if (square.materials) text += material_objects();
    text += " Model: 5, \"Model::head\", \"Mesh\" {\n  Version: 232\n }\n" + shape_objects();
    if (square.skinned) text += skin_objects(square);
    return text + animation_objects(square) + "}\n" + connections(square);
}

}  // namespace mien::fbx_text
