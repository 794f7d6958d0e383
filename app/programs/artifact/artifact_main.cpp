/// frustumscreen-artifact: writes a built-in artifact's mesh as a GLB file, or a curator's folder with it; and what stands
/// in the example hall, as GLB files; and example sites.
#include "app/programs/artifact/example_sites.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/settings/language_tag.h"
#include "assets_baked/artifacts/builtin.h"
#include "assets_baked/artifacts/hall/hall.h"
#include "assets_baked/artifacts/write_glb.h"
#include "assets_baked/folder/artifact_file.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace frustumscreen::programs {
namespace {

int report(const Error& error) {
    complain("frustumscreen-artifact", error);
    return 1;
}

/// The caption in a language; in English if there is none in it.
const pack::PackCaption& caption_in(const std::vector<pack::PackCaption>& captions,
                                    const std::string& language) {
    const auto found = std::find_if(captions.begin(), captions.end(), [&](const pack::PackCaption& caption) {
        return caption.language == language;
    });
    return found != captions.end() ? *found : captions.front();
}

int list_artifacts(const std::string& language) {
    for (const std::string_view name : artifacts::builtin_names()) {
        const Result<folder::ArtifactFile> file =
            folder::parse_artifact_file(artifacts::builtin_folder_text(name), folder::artifact_file_name);
        if (!file) {
            return report(file.error());
        }
        const pack::PackCaption& caption = caption_in(file->texts, language);
        fmt::print("{}\t{}\t{}\n", name, caption.title, caption.text);
    }
    return 0;
}

int list_sites() {
    for (const ExampleSite& site : example_sites()) {
        fmt::print("{}\t{}\n", site.name, site.what);
    }
    return 0;
}

int list_hall() {
    for (const artifacts::HallObject& object : artifacts::hall_objects()) {
        fmt::print("{}\t{}\t{}\n", object.name,
                   object.kind == artifacts::HallKind::Building ? "unlit" : "lit", object.what);
    }
    return 0;
}

/// Writes the mesh and, if `folder` is given, its layers and its artifact.toml beside it.
Result<void> write_artifact(const std::string& name, std::int64_t triangles,
                            const std::filesystem::path& output, const std::filesystem::path& folder) {
    const bool is_site = is_example_site(name);
    TRY(const bake::SourceMesh mesh,
        is_site ? make_example_site(name, triangles) : artifacts::make_builtin(name, triangles));
    TRY(const Bytes bytes, artifacts::write_glb(mesh));
    if (folder.empty()) {
        return write_file(output, bytes);
    }
    const std::string text =
        is_site ? example_site_text(name) : std::string(artifacts::builtin_folder_text(name));
    if (text.empty()) {
        return bad_input("artifact.no_texts",
                         "'{}' stands in the example hall and has no texts; write its mesh with -o", name);
    }
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) {
        return bad_input("artifact.no_folder", "{}: this folder cannot be made: {}", folder.string(),
                         failed.message());
    }
    for (const artifacts::BuiltinLayer& layer : artifacts::builtin_layers(name)) {
        TRY_VOID(write_file(folder / layer.file, image::encode_png(layer.picture)));
    }
    return write_file(folder / (name + ".glb"), bytes).and_then([&] {
        return write_file(folder / folder::artifact_file_name, as_bytes(text));
    });
}

int run(int argc, char** argv) {
    std::string name;
    std::string language = "en";
    std::int64_t triangles = 400'000;
    std::filesystem::path output;
    std::filesystem::path folder;
    bool list = false;
    bool list_of_hall = false;
    bool list_of_sites = false;

    CommandLine app{"Writes a built-in artifact's mesh as a GLB file (millimetres, +Y up).",
                    "frustumscreen-artifact"};
    app.set_version_flag("--version", name_and_version("frustumscreen-artifact"));
    const CommandOption name_option = app.add_option(
        "name", name, "name of the artifact, as --list, --list-hall and --list-sites print it");
    app.add_option("--triangles", triangles, "number of triangles, within 5 %").capture_default_str();
    const CommandOption output_option = app.add_option("-o,--output", output, "GLB file to write");
    const CommandOption folder_option =
        app.add_option("--folder", folder,
                       "folder to write instead: the mesh and an artifact.toml with texts and hotspots for "
                       "frustumscreen-bake")
            .excludes(output_option);
    const CommandOption list_option =
        app.add_flag("--list", list, "print name, title and text of each artifact, separated by tabs");
    app.add_option("--language", language, "language of --list: en, de, fr, es or el").capture_default_str();
    const CommandOption hall_option =
        app.add_flag("--list-hall", list_of_hall,
                     "print what stands in the example hall (config/hall/room.toml): name, 'lit' where the "
                     "bake gives it its light "
                     "or 'unlit' where its colours have it, and what it is, separated by tabs");
    const CommandOption sites_option = app.add_flag(
        "--list-sites", list_of_sites, "print name and kind of each example site, separated by tabs");
    sites_option.excludes(name_option).excludes(output_option).excludes(folder_option).excludes(list_option);
    hall_option.excludes(sites_option)
        .excludes(name_option)
        .excludes(output_option)
        .excludes(folder_option)
        .excludes(list_option);
    list_option.excludes(name_option).excludes(output_option).excludes(folder_option);
    if (const auto end = app.end_of_arguments(argc, argv, [&] {
            if (!list && !list_of_hall && !list_of_sites &&
                (name.empty() || (output.empty() && folder.empty()))) {
                throw missing("NAME and -o or --folder, or --list, --list-hall or --list-sites,");
            }
        })) {
        return *end;
    }
    if (!settings::parse_language_tag(language)) {
        fmt::print(stderr,
                   "frustumscreen-artifact: --language '{}': there is no such language; allowed are {}\n",
                   printable(language, 40), settings::allowed_language_tags);
        return 2;
    }
    if (list) {
        return list_artifacts(language);
    }
    if (list_of_hall) {
        return list_hall();
    }
    if (list_of_sites) {
        return list_sites();
    }
    const Result<void> written = write_artifact(name, triangles, output, folder);
    return written ? 0 : report(written.error());
}

} // namespace
} // namespace frustumscreen::programs

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen-artifact", frustumscreen::programs::run, argc,
                                                 argv);
}
