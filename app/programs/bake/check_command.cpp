#include "app/programs/bake/check_command.h"

#include "app/programs/bake/bake_options.h"
#include "app/programs/bake/check_report.h"
#include "app/programs/bake/check_scan.h"
#include "app/programs/batch/collection.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/common/progress_line.h"
#include "assets_baked/folder/artifact_file.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

namespace frustumscreen::programs {

namespace {

namespace fs = std::filesystem;

constexpr const char* program = "frustumscreen-bake";

struct Arguments {
    bool check = false;
    std::vector<fs::path> inputs;
    bool json = false;
    BakeArguments bake;
};

/// The scans to look at; a folder without any has its fault already.
struct Listed {
    std::vector<CheckedScan> scans;
    std::vector<std::string> skipped;
    bool is_table = false;
};

CheckedScan faulty(const fs::path& input, Error fault) {
    CheckedScan scan;
    scan.input = input;
    scan.fault = std::move(fault);
    return scan;
}

void list_folder(const fs::path& folder, Listed& listed) {
    const Result<Collection> collection = list_collection(folder, {});
    if (!collection) {
        listed.scans.push_back(faulty(folder, collection.error()));
        return;
    }
    for (const BatchObject& object : collection->objects) {
        listed.scans.emplace_back().input =
            object.input; // one that a batch refuses for its name can be baked alone
    }
    listed.skipped.insert(listed.skipped.end(), collection->skipped.begin(), collection->skipped.end());
    if (collection->objects.empty()) {
        listed.scans.push_back(faulty(
            folder, {ErrorKind::BadInput, "check.no_scan",
                     folder.string() + ": there is no scan in this folder, and no folder with an "
                                       "artifact.toml; name the scans, or the folder in which they lie"}));
    }
}

Listed list_scans(const std::vector<fs::path>& inputs) {
    Listed listed;
    for (const fs::path& input : inputs) {
        std::error_code none;
        if (fs::is_directory(input, none) && !fs::exists(input / folder::artifact_file_name, none)) {
            listed.is_table = true;
            list_folder(input, listed);
        } else {
            listed.scans.emplace_back().input = input;
        }
    }
    listed.is_table = listed.is_table || listed.scans.size() > 1;
    return listed;
}

void look_at_all(std::vector<CheckedScan>& scans, const BakeArguments& bake) {
    ProgressLine progress("looking at the scans: ");
    std::size_t done = 0;
    for (CheckedScan& scan : scans) {
        if (!scan.fault) {
            BakeArguments arguments = bake;
            arguments.input = scan.input;
            scan = check_scan(std::move(arguments));
        }
        progress.show(++done, scans.size());
    }
}

void print(const Listed& listed, bool as_json) {
    if (as_json) {
        nlohmann::ordered_json json = check_json(listed.scans);
        json["passed_over"] = listed.skipped;
        fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
        return;
    }
    if (!listed.is_table) {
        fmt::print("{}", check_lines(listed.scans.front()));
        if (const std::optional<Error>& fault = listed.scans.front().fault) {
            complain(program, *fault);
        }
        return;
    }
    fmt::print("{}", check_table(listed.scans));
    if (!listed.skipped.empty()) {
        fmt::print("Skipped folders without an artifact.toml: {}\n", fmt::join(listed.skipped, ", "));
    }
}

int status_of(const std::vector<CheckedScan>& scans) {
    int status = 0;
    for (const CheckedScan& scan : scans) {
        if (scan.fault) {
            status = std::max(status, scan.fault->kind == ErrorKind::BadConfiguration ? 2 : 1);
        }
    }
    return status;
}

} // namespace

int check_command(int argc, char** argv) {
    Arguments arguments;
    CommandLine app("Lists in seconds what scans contain, what a bake would lose, and how large the pack "
                    "would be; several scans make a table. Exit status: 0 all can be baked, 1 one cannot.",
                    program);
    app.set_version_flag("--version", name_and_version(program));
    app.add_flag("--check", arguments.check, "bakes and writes nothing");
    app.add_option("FILE", arguments.inputs, "scans, folders with an artifact.toml, or folders of these");
    app.add_flag("--json", arguments.json, "print JSON");
    app.add_option("--texture", arguments.bake.texture,
                   "picture of the colours, if a file names none or a missing one");
    add_bake_options(app, arguments.bake);
    if (const auto end = app.end_of_arguments(argc, argv, [&] {
            if (arguments.inputs.empty()) {
                throw missing("FILE, a scan or a folder of scans,");
            }
        })) {
        return *end;
    }
    Listed listed = list_scans(arguments.inputs);
    look_at_all(listed.scans, arguments.bake);
    print(listed, arguments.json);
    return status_of(listed.scans);
}

} // namespace frustumscreen::programs
