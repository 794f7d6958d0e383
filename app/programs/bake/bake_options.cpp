#include "app/programs/bake/bake_options.h"

#include "app/programs/common/command_line.h"

#include <fmt/format.h>

namespace frustumscreen::programs {

void add_bake_options(CommandLine& app, BakeArguments& arguments) {
    app.add_flag("--force", arguments.force, "replace an output file that is not a pack");
    app.add_option("--size", arguments.size, "texels along the longest edge of a face (default: 512)")
        .within(16, 4096);
    app.add_flag("--unlit", arguments.unlit,
                 "use the base colour without museum light, for colours that already contain light");
    app.add_flag("--no-relief", arguments.no_relief,
                 "leave out the layered relief: the pack is smaller and has meshes only");
    app.add_flag("--far", arguments.far,
                 "add coarse reliefs, for an artifact that stands far away in the room behind a screen");
    app.add_option(
           "--cells", arguments.cells,
           "parts of the model that can move by themselves: nodes of a glTF file, or none (default: nodes "
           "if an animation or artifact.toml moves them); auto: where nothing moves, parts that are quicker "
           "to draw one by one, if there are any")
        .one_of({"none", "nodes", "auto"});
    app.add_flag("--site", arguments.site,
                 "the scan is a site, terrain and buildings: its ground is cut into regions, each of which "
                 "visitors can have large in the prop");
    app.add_option(
        "--prop", arguments.prop,
        "prop that the artifact is baked for: frustum, cube, or a prop file, *.obj, of a prop in the hand "
        "(default: frustum)");
    app.add_option("--up", arguments.up, "the file's up axis (default: y; STL: z)")
        .one_of({"x", "y", "z", "-x", "-y", "-z"});
    app.add_option("--turn", arguments.turn_deg,
                   "turn about the vertical axis, degrees, counter-clockwise seen from above; 0 = as in the "
                   "file (default: largest size, best side in front)")
        .within(-360.0, 360.0);
    app.add_option("--scale", arguments.scale,
                   "factor on the largest size that fits into the prop; above 1 the prop cuts the artifact "
                   "off (default: 1)")
        .within(0.05, 20.0);
    app.add_option(
           "--lift", arguments.lift,
           "height of the artifact above the prop's bottom, as a multiple of its own height (default: 0)")
        .within(0.0, 1.0);
    app.add_flag(
        "--clean", arguments.clean,
        "remove the few triangles that lie far from the rest and make the artifact small, and a flat surface "
        "under the object; turn closed parts that are inside out");
    app.add_flag("--strict", arguments.strict, "write nothing if any part of the file would be lost");
    app.add_option("--speech", arguments.speech,
                   "program that speaks descriptions without a recording: reads text from standard input, "
                   "writes WAV; {language} stands for the language; none: no voice (default: espeak-ng)");
    app.add_option("--language", arguments.languages,
                   "language to bake, BCP 47; repeat for each (default: the folder's, else en)");
    app.add_option("--licence", arguments.licence,
                   "licence of the scan, shown to visitors (default: the file's own)");
    app.add_option("--author", arguments.author,
                   "author of the scan, shown to visitors (default: the file's own)");
}

std::vector<std::string> bake_options_of(const BakeArguments& arguments) {
    std::vector<std::string> words;
    const auto add = [&](std::string_view option, const std::string& value) {
        words.emplace_back(fmt::format("{}={}", option, value)); // a value may begin with a dash
    };
    const auto add_number = [&](std::string_view option, const auto& value) {
        if (value) {
            add(option, fmt::format("{}", *value));
        }
    };
    const auto add_text = [&](std::string_view option, const std::string& value) {
        if (!value.empty()) {
            add(option, value);
        }
    };
    const auto add_flag = [&](const char* option, bool value) {
        if (value) {
            words.emplace_back(option);
        }
    };
    add_flag("--force", arguments.force);
    add_number("--size", arguments.size);
    add_flag("--unlit", arguments.unlit);
    add_flag("--no-relief", arguments.no_relief);
    add_flag("--far", arguments.far);
    add_text("--cells", arguments.cells);
    add_flag("--site", arguments.site);
    add_text("--prop", arguments.prop.value_or(""));
    add_text("--up", arguments.up.value_or(""));
    add_number("--turn", arguments.turn_deg);
    add_number("--scale", arguments.scale);
    add_number("--lift", arguments.lift);
    add_flag("--clean", arguments.clean);
    add_flag("--strict", arguments.strict);
    add_text("--speech", arguments.speech);
    for (const std::string& language : arguments.languages) {
        add("--language", language);
    }
    add_text("--licence", arguments.licence);
    add_text("--author", arguments.author);
    return words;
}

} // namespace frustumscreen::programs
