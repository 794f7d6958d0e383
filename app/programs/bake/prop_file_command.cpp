#include "app/programs/bake/prop_file_command.h"

#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/solid/make_solid.h"
#include "app/solid/prop_file.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/load_mesh.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/output_file.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>

namespace frustumscreen::programs {

namespace {

namespace fs = std::filesystem;

constexpr const char* program = "frustumscreen-bake";

struct Arguments {
    fs::path input;
    fs::path output;
    std::string unit = "mm";
    std::string up = "z";
    bool force = false;
    bool json = false;
};

/// Polygons as the file has them, and what was lost of them.
struct Polygons {
    solid::PolygonMesh mesh;
    std::vector<std::string> notes;
};

bool is_obj(const fs::path& file) {
    const std::string extension = file.extension().string();
    constexpr std::string_view obj = ".obj";
    return std::equal(extension.begin(), extension.end(), obj.begin(), obj.end(),
                      [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + ('a' - 'A') : a) == b; });
}

/// By the kiosk's own reader, which knows lines and groups.
Result<Polygons> read_obj(const Arguments& arguments, solid::LengthUnit unit) {
    TRY(const Bytes bytes, read_file(arguments.input));
    TRY(solid::ObjText obj, at(arguments.input.string(), solid::parse_obj(as_text(bytes), unit)));
    return Polygons{std::move(obj.mesh), std::move(obj.notes)};
}

Result<Polygons> read_triangles(const Arguments& arguments, solid::LengthUnit unit) {
    TRY(const bake::SourceMesh source, bake::load_mesh(arguments.input));
    if (source.contents.format != "STL" && source.contents.format != "PLY") {
        return bad_input(
            "prop_file.format",
            "{}: it is a {} file; a prop file is made from an STL, PLY or OBJ file: export it as one "
            "of these",
            arguments.input.string(), source.contents.format);
    }
    Polygons polygons;
    polygons.mesh.unit = unit;
    polygons.mesh.numbers = solid::PolygonMesh::Numbers::Triangles;
    for (const glm::dvec3& position : source.positions) {
        polygons.mesh.vertices.push_back(unit == solid::LengthUnit::Millimetre ? position / 1000.0
                                                                               : position);
    }
    for (const auto& [a, b, c] : source.triangles) {
        const std::size_t number = polygons.mesh.polygons.size() + 1;
        polygons.mesh.polygons.push_back({.corners = {a, b, c}, .name = {}, .number = number});
    }
    for (const bake::SourceNote& note : source.notes) {
        polygons.notes.push_back("lost or guessed: " + note.text);
    }
    return polygons;
}

/// Moves the solid onto z = 0, and onto its axis if that runs beside it; tells by how much.
solid::Solid stood_up(const solid::Solid& solid, std::vector<std::string>& notes) {
    const auto moved_by = [&](const glm::dvec3& by) {
        return solid::moved(solid, {{1.0, 0.0, 0.0, 0.0}, by});
    };
    const solid::SolidBox box = solid::box_around(solid);
    glm::dvec3 by(0.0, 0.0, -box.low.z);
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    by = solid::check_stand(moved_by(by)) ? by : glm::dvec3(-middle.x, -middle.y, by.z);
    constexpr double told_m = 1e-5; // less is rounding
    if (glm::length(by) > told_m) {
        notes.push_back(fmt::format("it is moved by {}: it stands on z = 0, and x = y = 0 runs through it",
                                    solid::in_mm(by)));
    }
    solid::Solid stood = moved_by(by);
    if (const Result<void> foot = solid::check_foot(stood); !foot) {
        notes.push_back("not yet a prop for the settings: " + foot.error().message);
    }
    return stood;
}

Result<solid::PropFile> prop_file_of(const Arguments& arguments) {
    const solid::LengthUnit unit =
        arguments.unit == "m" ? solid::LengthUnit::Metre : solid::LengthUnit::Millimetre;
    TRY(Polygons polygons,
        is_obj(arguments.input) ? read_obj(arguments, unit) : read_triangles(arguments, unit));
    const glm::dmat3 prop_from_file = bake::up_rotation(arguments.up).value_or(glm::dmat3(1.0));
    for (glm::dvec3& vertex : polygons.mesh.vertices) {
        vertex = prop_from_file * vertex;
    }
    TRY(solid::MadeSolid made, at(arguments.input.string(), solid::make_solid(std::move(polygons.mesh))));
    solid::PropFile file{.solid = {}, .notes = std::move(polygons.notes)};
    std::move(made.notes.begin(), made.notes.end(), std::back_inserter(file.notes));
    file.solid = stood_up(made.solid, file.notes);
    return file;
}

/// Whether a prop file of ours may be replaced.
bool is_prop_file(const fs::path& file) {
    const Result<Bytes> bytes = read_file(file, solid::max_obj_bytes);
    return bytes && as_text(*bytes).starts_with(solid::prop_file_heading);
}

Result<void> check_output(const Arguments& arguments) {
    TRY_VOID(check_output_place(arguments.output));
    TRY_VOID(check_output_is_no_input(arguments.output, std::array{arguments.input}));
    std::error_code ignored;
    if (!arguments.force && fs::exists(arguments.output, ignored) && !is_prop_file(arguments.output)) {
        return bad_input("prop_file.not_replaced",
                         "{}: this file exists and was not made by --prop-file; choose another name for the "
                         "output, or add --force to replace it",
                         arguments.output.string());
    }
    return {};
}

glm::dvec3 size_mm(const solid::Solid& solid) {
    const solid::SolidBox box = solid::box_around(solid);
    return (box.high - box.low) * 1e3;
}

std::string report_text(const Arguments& arguments, const solid::PropFile& file) {
    const glm::dvec3 size = size_mm(file.solid);
    std::string text =
        fmt::format("{}: {} faces, {:.1f} x {:.1f} x {:.1f} mm, least width {}, volume {:.1f} cm3\n",
                    arguments.output.string(), file.solid.faces.size(), size.x, size.y, size.z,
                    solid::in_mm(solid::min_width(file.solid).width_m), solid::volume_of(file.solid) * 1e6);
    for (const solid::SolidFace& face : file.solid.faces) {
        const glm::dvec3& n = face.plane.normal;
        text +=
            fmt::format("  {:<12} {} corners, {:.1f} cm2, looks along ({:.2f}, {:.2f}, {:.2f})\n", face.name,
                        face.corners.size(), solid::area_of(face) * 1e4, n.x + 0.0, n.y + 0.0, n.z + 0.0);
    }
    for (const std::string& note : file.notes) {
        text += fmt::format("note: {}\n", note);
    }
    if (const auto narrow = solid::narrowness(file.solid)) {
        text += fmt::format("warning: {}\n", *narrow);
    }
    return text;
}

nlohmann::ordered_json report_json(const Arguments& arguments, const solid::PropFile& file) {
    const auto numbers = [](const glm::dvec3& v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
    nlohmann::ordered_json faces = nlohmann::ordered_json::array();
    for (const solid::SolidFace& face : file.solid.faces) {
        nlohmann::ordered_json corners = nlohmann::ordered_json::array();
        for (const glm::dvec3& corner : face.corners) {
            corners.push_back(numbers(corner * 1e3));
        }
        faces.push_back(
            {{"name", face.name}, {"normal", numbers(face.plane.normal)}, {"corners_mm", corners}});
    }
    const auto narrow = solid::narrowness(file.solid);
    return {{"file", arguments.output.string()},
            {"faces", faces},
            {"size_mm", numbers(size_mm(file.solid))},
            {"least_width_mm", solid::min_width(file.solid).width_m * 1e3},
            {"volume_cm3", solid::volume_of(file.solid) * 1e6},
            {"notes", file.notes},
            {"warnings", narrow ? std::vector{*narrow} : std::vector<std::string>{}}};
}

Result<void> work(const Arguments& arguments) {
    TRY_VOID(check_output(arguments));
    TRY(const solid::PropFile file, prop_file_of(arguments));
    const std::string text = solid::write_prop_file(file.solid);
    // As the kiosk reads it: rounding may make a corner that is hardly in its plane lie beside it.
    TRY_VOID(without_value(
        at(arguments.input.string(), solid::parse_prop_file(text, solid::LengthUnit::Millimetre))));
    TRY_VOID(write_file(arguments.output, as_bytes(text)));
    using Handler = nlohmann::ordered_json::error_handler_t;
    fmt::print("{}", arguments.json
                         ? report_json(arguments, file).dump(2, ' ', false, Handler::replace) + "\n"
                         : report_text(arguments, file));
    return {};
}

} // namespace

int prop_file_command(int argc, char** argv) {
    Arguments arguments;
    CommandLine app(
        "Makes a prop file, the shape of a prop as a plain OBJ in millimetres, from an STL, PLY or OBJ "
        "file, and says what it found. The shape must be one closed, convex body of 4 to 16 flat faces; "
        "it is refused otherwise, and never made convex.",
        program);
    app.set_version_flag("--version", name_and_version(program));
    app.add_option("--prop-file", arguments.input, "STL, PLY or OBJ file of the prop's shape")
        .type_name("FILE")
        .expected(0, 1);
    app.add_option("-o,--output", arguments.output, "prop file to write (*.obj)");
    app.add_option("--unit", arguments.unit, "unit of the file's numbers (default: mm)").one_of({"mm", "m"});
    app.add_option("--up", arguments.up, "the file's axis that points up (default: z)")
        .one_of({"x", "y", "z", "-x", "-y", "-z"});
    app.add_flag("--force", arguments.force, "replace the output also if it is another file");
    app.add_flag("--json", arguments.json, "the report for programs");
    if (const auto end = app.end_of_arguments(argc, argv, [&] {
            if (arguments.input.empty()) {
                throw WrongUse{
                    "--prop-file needs FILE, the STL, PLY or OBJ file of the prop's shape, after it"};
            }
            if (arguments.output.empty()) {
                throw missing("-o NAME.obj, the prop file to write,");
            }
        })) {
        return *end;
    }
    return exit_status(program, work(arguments));
}

} // namespace frustumscreen::programs
