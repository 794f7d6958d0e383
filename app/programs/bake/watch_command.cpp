#include "app/programs/bake/watch_command.h"

#include "app/programs/bake/bake_options.h"
#include "app/programs/batch/child_sentence.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/preview/preview_page.h"
#include "app/programs/watch/folder_watch.h"
#include "app/programs/watch/settle_time.h"
#include "assets_baked/folder/artifact_file.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/run_program.h"
#include "firmware_host/base/version.h"
#include "firmware_host/service/stop_signals.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace frustumscreen::programs {

namespace {

constexpr const char* program = "frustumscreen-bake";
constexpr Nanoseconds quiet = std::chrono::milliseconds(300);
constexpr int coarse_size = 128; ///< texels; 512 texels take several times as long
constexpr int look_ms = 100;     ///< interval between checks for a stop signal

struct Arguments {
    std::filesystem::path folder;
    std::filesystem::path page; ///< empty: beside the folder
    std::filesystem::path pack; ///< empty: not kept
    BakeArguments bake;
};

/// Temporary folder for the pack that the page is drawn from, if the pack is not kept.
class PassingFolder {
public:
    PassingFolder() {
        std::error_code none;
        std::string name = std::filesystem::temp_directory_path(none) / "frustumscreen_watch_XXXXXX";
        path_ = ::mkdtemp(name.data()) != nullptr ? name : "";
    }
    ~PassingFolder() {
        std::error_code none;
        if (!path_.empty()) {
            std::filesystem::remove_all(path_, none);
        }
    }
    PassingFolder(const PassingFolder&) = delete;
    PassingFolder& operator=(const PassingFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// The page of vase/ is vase.preview.html beside it.
std::filesystem::path page_beside(const std::filesystem::path& folder) {
    std::error_code none;
    const std::filesystem::path whole =
        std::filesystem::absolute(folder / "", none).lexically_normal().parent_path();
    const std::filesystem::path page = whole.parent_path() / (whole.filename().string() + ".preview.html");
    return std::filesystem::proximate(page, none);
}

void say(const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
}

class Watching {
public:
    Watching(const Arguments& arguments, const std::filesystem::path& pack)
        : arguments_(arguments), command_{"/proc/self/exe",
                                          arguments.folder.string(),
                                          "--output=" + pack.string(),
                                          "--preview=" + arguments.page.string(),
                                          "--while-watched",
                                          "--json"} {
        const std::vector<std::string> options = bake_options_of(arguments.bake);
        command_.insert(command_.end(), options.begin(), options.end());
    }

    [[nodiscard]] Result<void> run() {
        TRY(FolderWatch watch, FolderWatch::open(arguments_.folder));
        say(fmt::format("watching {}; open {} in a browser; Ctrl-C ends", arguments_.folder.string(),
                        arguments_.page.string()));
        Result<void> baked = bake();
        while (baked && !stopped()) {
            pollfd waited{watch.descriptor(), POLLIN, 0};
            ::poll(&waited, 1, look_ms);
            const Result<bool> changed = watch.take();
            if (!changed) {
                baked = tl::unexpected<Error>(changed.error());
                break;
            }
            if (*changed) {
                settle_.changed(monotonic_now());
            }
            if (settle_.take(monotonic_now())) {
                baked = bake();
            }
        }
        rest_page();
        return baked;
    }

private:
    bool stopped() {
        stopped_ = stopped_ || stop_.received();
        return stopped_;
    }

    /// Bakes once. An error in the folder is printed and the page stays as it was; an error of the program ends the
    /// watching.
    Result<void> bake() {
        const MonotonicTime start = monotonic_now();
        ProgramLimits limits;
        limits.time = std::chrono::hours(1);
        limits.complaint_bytes = std::size_t{1} << 20;
        limits.given_up = [this] { return stopped(); };
        TRY(const ProgramEnd end, follow_program(command_, "", limits));
        if (end.how == ProgramEnd::How::GivenUp) {
            return {};
        }
        const double seconds = to_seconds(monotonic_now() - start);
        if (const std::string sentence = sentence_of(end, limits); !sentence.empty()) {
            say(fmt::format("{} ({:.1f} s; {})", sentence, seconds,
                            has_page_ ? "the page stays as it was" : "there is no page yet"));
            return {};
        }
        has_page_ = true;
        say(fmt::format("{}: new after {:.1f} s", arguments_.page.string(), seconds));
        return {};
    }

    /// Stops the page from reloading itself, because it is not drawn again.
    void rest_page() const {
        const Result<Bytes> page = has_page_ ? read_file(arguments_.page) : Result<Bytes>(Bytes());
        if (page && !page->empty()) {
            (void)write_file(arguments_.page, as_bytes(without_reloading(std::string(as_text(*page)))));
        }
    }

    const Arguments& arguments_;
    std::vector<std::string> command_;
    service::StopSignals stop_;
    SettleTime settle_{quiet};
    bool stopped_ = false;
    bool has_page_ = false;
};

/// An output inside the watched folder would count as a change and start the next bake.
Result<void> check_is_outside(const std::filesystem::path& written, const std::filesystem::path& folder) {
    std::error_code none;
    const std::filesystem::path way =
        std::filesystem::weakly_canonical(written, none)
            .lexically_relative(std::filesystem::weakly_canonical(folder, none));
    if (!written.empty() && !way.empty() && *way.begin() != "..") {
        return bad_input("watch.output_inside",
                         "{}: this lies in the watched folder; name a place outside {}", written.string(),
                         folder.string());
    }
    return {};
}

Result<void> work(Arguments arguments) {
    std::error_code none;
    for (const std::filesystem::path& written : {arguments.page, arguments.pack}) {
        TRY_VOID(check_is_outside(written, arguments.folder));
    }
    if (!std::filesystem::is_directory(arguments.folder, none)) {
        return bad_input("watch.no_folder",
                         "{}: this is not a folder; --watch needs the folder of an artifact, and "
                         "frustumscreen-bake --new FOLDER SCAN makes one",
                         arguments.folder.string());
    }
    if (!std::filesystem::exists(arguments.folder / folder::artifact_file_name, none)) {
        return without_value(folder::read_artifact_file(arguments.folder));
    }
    arguments.page = arguments.page.empty() ? page_beside(arguments.folder) : arguments.page;
    arguments.bake.size = arguments.bake.size.value_or(coarse_size);
    const PassingFolder passing;
    if (arguments.pack.empty() && passing.path().empty()) {
        return fail(ErrorKind::Internal, "watch.no_temporary_place",
                    "there is no folder for temporary files; set TMPDIR to a folder that can be written, or "
                    "name a pack with -o");
    }
    return Watching(arguments, arguments.pack.empty() ? passing.path() / "coarse.fspack" : arguments.pack)
        .run();
}

} // namespace

int watch_command(int argc, char** argv) {
    Arguments arguments;
    CommandLine app("Bakes a coarse preview of a folder at each change of a file in it. A browser that shows "
                    "the page reloads it.",
                    program);
    app.set_version_flag("--version", name_and_version("frustumscreen-bake"));
    app.add_option("--watch", arguments.folder, "FOLDER with an artifact.toml").expected(0, 1);
    app.add_option("--preview", arguments.page,
                   "page to write (default: FOLDER.preview.html beside the folder)");
    app.add_option("-o,--output", arguments.pack, "coarse pack to keep (default: none)");
    add_bake_options(app, arguments.bake);
    if (const auto end = app.end_of_arguments(argc, argv, [&] {
            if (arguments.folder.empty()) {
                throw WrongUse{"--watch needs FOLDER, the folder of an artifact, after it"};
            }
        })) {
        return *end;
    }
    return exit_status(program, work(std::move(arguments)));
}

} // namespace frustumscreen::programs
