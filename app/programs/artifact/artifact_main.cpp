/// frustumscreen-artifact: writes a built-in artifact's mesh as a GLB file.
#include "app/programs/common/guarded_main.h"
#include "app/settings/language_tag.h"
#include "assets_baked/artifacts/builtin.h"
#include "assets_baked/artifacts/write_glb.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

namespace frustumscreen {
namespace {

int report(const Error& error) {
    fmt::print(stderr, "frustumscreen-artifact: {}\n", error.message);
    return 1;
}

int list_artifacts(const std::string& language) {
    for (const std::string_view name : builtin_names()) {
        const BuiltinText text = builtin_text(name, language);
        fmt::print("{}\t{}\t{}\n", name, text.title, text.text);
    }
    return 0;
}

int run(int argc, char** argv) {
    std::string name;
    std::string language = "en";
    std::int64_t triangles = 400'000;
    std::filesystem::path output;
    bool list = false;

    CLI::App app{"Writes a built-in artifact's mesh as a GLB file (millimetres, +Y up).",
                 "frustumscreen-artifact"};
    app.set_version_flag("--version", "frustumscreen-artifact " FRUSTUMSCREEN_VERSION);
    auto* name_option = app.add_option("name", name, "Name of the artifact; --list shows them");
    app.add_option("--triangles", triangles, "Number of triangles, kept within 5 %")->capture_default_str();
    auto* output_option = app.add_option("-o,--output", output, "GLB file to write");
    auto* list_option = app.add_flag("--list", list, "Print name, title and text of each, separated by tabs");
    app.add_option("--language", language, "Language of --list: en, de, fr, es, el; English for others")
        ->capture_default_str();
    list_option->excludes(name_option)->excludes(output_option);
    try {
        app.parse(argc, argv);
        if (!list && (name.empty() || output.empty())) {
            throw CLI::RequiredError("NAME and -o, or --list,");
        }
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (!parse_language_tag(language)) {
        fmt::print(stderr,
                   "frustumscreen-artifact: --language '{}': there is no such language; allowed are {}\n",
                   printable(language, 40), allowed_language_tags);
        return 2;
    }
    if (list) {
        return list_artifacts(language);
    }
    const auto mesh = make_builtin(name, triangles);
    if (!mesh) {
        return report(mesh.error());
    }
    const auto bytes = write_glb(*mesh);
    if (!bytes) {
        return report(bytes.error());
    }
    const auto written = write_file(output, *bytes);
    return written ? 0 : report(written.error());
}

} // namespace
} // namespace frustumscreen

int main(int argc, char** argv) {
    return frustumscreen::guarded_main("frustumscreen-artifact", frustumscreen::run, argc, argv);
}
