/// frustumscreen-bake: a curator's artifact file to a pack.
#include "app/programs/bake/bake_options.h"
#include "app/programs/bake/bake_preview.h"
#include "app/programs/bake/bake_report.h"
#include "app/programs/bake/bake_request.h"
#include "app/programs/bake/bake_work.h"
#include "app/programs/bake/batch_command.h"
#include "app/programs/bake/check_command.h"
#include "app/programs/bake/prop_file_command.h"
#include "app/programs/bake/watch_command.h"
#include "app/programs/bake/words_command.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "assets_baked/bake/load_mesh.h"
#include "assets_baked/folder/new_folder.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>

namespace frustumscreen::programs {
namespace {

/// --new: makes a folder from a scan.
Result<void> start(const BakeArguments& arguments) {
    TRY(const bake::SourceMesh mesh, bake::load_mesh(arguments.input, {arguments.texture}));
    folder::ScanFacts scan{.file = arguments.input,
                           .side_files = mesh.side_files,
                           .low = mesh.positions.front(),
                           .high = mesh.positions.front(),
                           .default_up = mesh.default_up,
                           .title = mesh.about.title,
                           .author = mesh.about.author,
                           .licence = mesh.about.licence,
                           .source = mesh.about.source};
    for (const glm::dvec3& position : mesh.positions) {
        scan.low = glm::min(scan.low, position);
        scan.high = glm::max(scan.high, position);
    }
    TRY(const std::filesystem::path file, folder::start_folder(arguments.new_folder, scan));
    fmt::print("{}: edit it, then: frustumscreen-bake {} -o {}.fspack\n", file.string(),
               arguments.new_folder.string(), arguments.input.stem().string());
    return {};
}

/// Prints the error and returns the exit status.
int status_of(const Error& error) {
    complain("frustumscreen-bake", error);
    return error.kind == ErrorKind::BadConfiguration ? 2 : 1;
}

int bake_and_report(const BakeArguments& arguments) {
    if (!arguments.new_folder.empty()) {
        const Result<void> started = start(arguments);
        return started ? 0 : status_of(started.error());
    }
    const Result<BakeRequest> request = request_of(arguments);
    if (!request) {
        return status_of(request.error());
    }
    if (const Result<void> checked = check_preview(*request); !checked) {
        return status_of(checked.error());
    }
    Result<BakeResult> done = bake_pack(*request);
    if (!done) {
        return status_of(done.error());
    }
    const Result<std::uint64_t> page_bytes = write_preview(*request, *done);
    if (!page_bytes) {
        return status_of({page_bytes.error().kind, page_bytes.error().id,
                          fmt::format("{} is written, but its preview is not: {}", done->file.string(),
                                      page_bytes.error().message)});
    }
    done->page = request->preview;
    done->page_bytes = *page_bytes;
    fmt::print("{}", arguments.json ? report_json(*done).dump(2) + "\n" : report_text(*done));
    return 0;
}

void add_options(CommandLine& app, BakeArguments& arguments) {
    app.add_option("INPUT", arguments.input, "artifact file, or a folder with an artifact.toml");
    const CommandOption output = app.add_option("-o,--output", arguments.output, "pack to write (*.fspack)");
    app.add_option("--new", arguments.new_folder,
                   "start a folder: copy the artifact file INPUT into it and write an artifact.toml to edit; "
                   "nothing is baked")
        .type_name("FOLDER")
        .excludes(output);
    app.add_option("--preview", arguments.preview,
                   "preview page to write (*.html): pictures, texts and errors of the pack");
    app.add_flag("--json", arguments.json, "print the report as JSON");
    app.add_flag("--while-watched", arguments.watched).hidden(); // given by --watch
    app.add_option("--texture", arguments.texture,
                   "picture of the colours, if the file names none or a missing one");
    app.add_option("--title", arguments.title,
                   "title in every language (default: the folder's, else the file's name)");
    app.add_option("--caption", arguments.captions, "short text, as LANGUAGE=TEXT; repeat for each language");
    add_bake_options(app, arguments);
}

int run(int argc, char** argv) {
    if (names_option(argc, argv, "--words")) {
        return words_command(argc, argv);
    }
    if (names_option(argc, argv, "--watch")) {
        return watch_command(argc, argv);
    }
    if (names_option(argc, argv, "--batch")) {
        return batch_command(argc, argv);
    }
    if (names_option(argc, argv, "--check")) {
        return check_command(argc, argv);
    }
    if (names_option(argc, argv, "--prop-file")) {
        return prop_file_command(argc, argv);
    }
    BakeArguments arguments;
    CommandLine app(
        "Bakes an artifact (glTF, OBJ, PLY, STL) into a pack. Options override the folder's artifact.toml.",
        "frustumscreen-bake");
    app.set_version_flag("--version", name_and_version("frustumscreen-bake"));
    app.footer("Other modes: --watch FOLDER renews a folder's preview page at each change; --batch DIR bakes "
               "a collection; --check FILE... lists in seconds what scans contain and what a bake would "
               "lose; --words bakes the exhibit's own words; --prop-file FILE makes the file of a "
               "prop's shape. Add --help to each for its options.");
    add_options(app, arguments);
    if (const auto end = app.end_of_arguments(argc, argv, [&] {
            if (arguments.input.empty()) {
                throw missing(arguments.new_folder.empty()
                                  ? "INPUT, a scan or a folder with an artifact.toml,"
                                  : "the scan, after the folder of --new,");
            }
            if (arguments.output.empty() && arguments.new_folder.empty()) {
                throw missing("-o NAME.fspack, the pack to write,");
            }
        })) {
        return *end;
    }
    try {
        return bake_and_report(arguments);
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "frustumscreen-bake: {}: not enough memory; try a smaller --size\n",
                   arguments.input.string());
        return 1;
    }
}

} // namespace
} // namespace frustumscreen::programs

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen-bake", frustumscreen::programs::run, argc,
                                                 argv);
}
