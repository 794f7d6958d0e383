#include "app/programs/bake/bake_options.h"

#include "app/programs/common/command_line.h"

#include <fmt/format.h>

namespace frustumscreen::programs {

void add_bake_options(CommandLine& app, BakeArguments& arguments) {
    app.add_flag("--force", arguments.force, "replace the output also if it is not a pack");
    app.add_option("--size", arguments.size,
                   "texels along the longest edge of a face, 16 to 4096 (default: 512)")
        .within(16, 4096);
    app.add_flag("--unlit", arguments.unlit,
                 "base colour alone, no museum light: for colours that already contain light");
    app.add_flag("--no-relief", arguments.no_relief,
                 "no layered relief: a smaller pack, of which the exhibit draws meshes alone");
    app.add_option("--prop", arguments.prop,
                   "prop whose directions the relief is made for (default: frustum)")
        .one_of({"frustum", "cube"});
    app.add_option("--up", arguments.up, "the file's up axis (default: glTF, OBJ, PLY y; STL z)")
        .one_of({"x", "y", "z", "-x", "-y", "-z"});
    app.add_option(
           "--turn", arguments.turn_deg,
           "degrees about the vertical axis, counter-clockwise seen from above; 0 = as the file has it "
           "(default: the largest size and the best side)")
        .within(-360.0, 360.0);
    app.add_option(
           "--scale", arguments.scale,
           "factor on the largest size that fits into the prop; above 1 the prop cuts it off (default: 1)")
        .within(0.05, 20.0);
    app.add_option(
           "--lift", arguments.lift,
           "raises the artifact above the prop's bottom, in heights of the artifact, 0 to 1 (default: 0)")
        .within(0.0, 1.0);
    app.add_flag(
        "--clean", arguments.clean,
        "leave out few triangles that lie far from the rest and make the artifact small; turn closed "
        "parts that are inside out");
    app.add_flag("--strict", arguments.strict,
                 "refuse a file of which something would be lost; nothing is written");
    app.add_option(
        "--speech", arguments.speech,
        "program that speaks descriptions without a recording: it takes text on standard input and "
        "writes WAV; {language} in it is replaced; none: no voice (default: espeak-ng)");
    app.add_option("--language", arguments.languages, "language of a caption, BCP 47; once for each");
    app.add_option("--licence", arguments.licence,
                   "licence of the scan; visitors read it (default: what the file says of itself)");
    app.add_option("--author", arguments.author,
                   "who made the scan, as its licence asks for; visitors read it (default: as above)");
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
