/// frustumscreen-import: takes a stick's packs into the installed set.
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/import/import_command.h"
#include "app/programs/import/import_watcher.h"
#include "firmware_host/base/folder_entries.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace frustumscreen::programs {
namespace {

/// Replaces each \xNN by its byte: udev writes so most punctuation and bytes that are not UTF-8 (ID_FS_LABEL_ENC).
std::string unescaped_label(std::string_view escaped) {
    constexpr std::string_view mark = "\\x";
    constexpr std::size_t digits = 2;
    std::string label;
    while (!escaped.empty()) {
        unsigned char byte = 0;
        const char* const first = escaped.data() + mark.size();
        if (escaped.starts_with(mark) && escaped.size() >= mark.size() + digits &&
            std::from_chars(first, first + digits, byte, 16).ptr == first + digits) {
            label.push_back(static_cast<char>(byte));
            escaped.remove_prefix(mark.size() + digits);
        } else {
            label.push_back(escaped.front());
            escaped.remove_prefix(1);
        }
    }
    return label;
}

/// The label in the name of the folder's first link that begins with `label=`; without such a link there is none. The
/// result may be any bytes: pass it through printable() before it is shown.
std::string label_in(const std::filesystem::path& folder) {
    constexpr std::string_view beginning = "label=";
    for (const std::filesystem::directory_entry& each : entries_of(folder)) {
        const std::string name = each.path().filename().string();
        if (name.starts_with(beginning)) {
            return unescaped_label(std::string_view(name).substr(beginning.size()));
        }
    }
    return {};
}

std::string line_of(const library::ImportedPack& pack) {
    const std::string name =
        pack.title.empty() ? pack.file : fmt::format("{} (\"{}\")", pack.file, pack.title);
    return fmt::format("{}: {}{}{}", name, words_of(pack.outcome), pack.reason.empty() ? "" : ": ",
                       pack.reason);
}

/// Prints a line for each pack, refused ones on standard error. The exit status is about the stick, not about each
/// pack.
int say(const library::ImportReport& report, const ImportArguments& arguments) {
    for (const library::ImportedPack& pack : report.packs) {
        if (pack.outcome == library::ImportOutcome::Refused ||
            pack.outcome == library::ImportOutcome::NotWritten) {
            fmt::print(stderr, "frustumscreen-import: {}\n", line_of(pack));
        } else if (!arguments.json) {
            fmt::print("{}\n", line_of(pack));
        }
    }
    if (arguments.json) {
        fmt::print("{}", library::write_import_report(report));
    }
    if (report.stage != library::ImportStage::Failed) {
        if (report.packs.empty() && !arguments.json) {
            fmt::print("no pack (*.fspack) was found; put packs into the stick's root, or one folder down\n");
        }
        return 0;
    }
    const bool is_said =
        std::any_of(report.packs.begin(), report.packs.end(), [&](const library::ImportedPack& pack) {
            return pack.reason.ends_with(report.reason) ||
                   (!pack.reason.empty() && report.reason.ends_with(pack.reason));
        });
    if (!is_said) {
        fmt::print(stderr, "frustumscreen-import: {}\n", report.reason);
    }
    return 1;
}

int list(const ImportArguments& arguments) {
    const Result<std::string> text = list_installed(arguments);
    if (!text) {
        return exit_status("frustumscreen-import", tl::unexpected<Error>(text.error()));
    }
    fmt::print("{}", *text);
    return 0;
}

int run(int argc, char** argv) {
    CommandLine app("Imports packs from a stick into the set that the exhibit shows. Only packs that are "
                    "signed and complete are taken.",
                    "frustumscreen-import");
    app.set_version_flag("--version", name_and_version("frustumscreen-import"));
    ImportArguments arguments;
    std::string unsigned_packs = "refuse";
    bool to_list = false;
    bool is_unmounted = false;
    bool has_ended = false;
    const CommandOption from =
        app.add_option("--from", arguments.from, "the stick's folder; it is only read");
    const CommandOption into =
        app.add_option("--into", arguments.into, "folder of the installed set; created if missing");
    const CommandOption keys =
        app.add_option("--keys", arguments.keys, "folder of the museum's public keys (*.pub)");
    const CommandOption config = app.add_option("--config", arguments.config,
                                                "settings, TOML, with exhibit.keys and exhibit.unsigned");
    app.add_option("--settings", arguments.settings,
                   "folder of the kiosk's kiosk.toml, which one on the stick replaces (signed, if the kiosk "
                   "names a key); a file settings-taken beside the report notes it");
    app.add_option("--unsigned", unsigned_packs,
                   "allow: also take packs without a signature, for a bench (default: refuse)")
        .one_of({"refuse", "allow"});
    app.add_option("--calibration", arguments.calibration,
                   "folder of the kiosk's calibrations; with --settings and --counts, a kiosk copy "
                   "(kiosk.fsk) is imported too, signed as settings are");
    app.add_option("--counts", arguments.counts, "folder of the kiosk's visits, for a kiosk copy");
    const CommandOption report =
        app.add_option("--report", arguments.report, "JSON file to write the progress and the result to");
    app.add_option("--report-stands", arguments.report_stands_s,
                   "seconds to leave another stick's finished report before it is replaced")
        .within(0.0, 60.0);
    app.add_option("--stick-report", arguments.stick_report,
                   "file with the outcome of frustumscreen report; it is reported, then removed");
    app.add_flag(
        "--confirmed", arguments.confirmed,
        "import a stick once more, after the staff have confirmed the copy for which it waited and the "
        "copy was written");
    const CommandOption label =
        app.add_option("--label", arguments.label, "the stick's name, for the report");
    std::string label_folder;
    app.add_option("--label-from", label_folder,
                   "folder where udev left the stick's name, as a link label=NAME")
        .excludes(label);
    app.add_flag("--json", arguments.json, "print JSON");
    const CommandOption list_flag = app.add_flag(
        "--list", to_list,
        "list the set that the exhibit would show at a start, and the valid keys; import nothing");
    app.add_flag("--unmounted", is_unmounted, "only report that a stick cannot be mounted");
    const CommandOption ended =
        app.add_flag("--ended", has_ended, "only report that an import was stopped (ExecStopPost=)");
    const CommandOption id =
        app.add_option("--id", arguments.id, "name of this import, different for each stick");
    ended.needs(id).needs(report);
    list_flag.needs(into).excludes(from);
    const auto check = [&] {
        if (to_list || is_unmounted || has_ended) {
            return;
        }
        for (const CommandOption& wanted : {from, into}) {
            if (wanted.count() == 0) {
                throw missing(wanted.get_name());
            }
        }
        if (keys.count() + config.count() == 0 && unsigned_packs == "refuse") {
            throw missing("--keys or --config");
        }
    };
    if (const auto end = app.end_of_arguments(argc, argv, check)) {
        return *end;
    }
    if (!label_folder.empty()) {
        arguments.label = label_in(label_folder);
    }
    if (has_ended) {
        const char* result = std::getenv("SERVICE_RESULT");
        return exit_status("frustumscreen-import", tell_ended(arguments, result != nullptr ? result : ""));
    }
    arguments.allow_unsigned = unsigned_packs == "allow";
    if (is_unmounted) {
        const std::optional<library::ImportReport> unmounted = tell_unmounted(arguments);
        return unmounted ? say(*unmounted, arguments) : 0;
    }
    return to_list ? list(arguments) : say(import_from(arguments), arguments);
}

} // namespace
} // namespace frustumscreen::programs

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen-import", frustumscreen::programs::run, argc,
                                                 argv);
}
