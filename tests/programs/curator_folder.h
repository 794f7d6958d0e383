// Folders of artifacts for tests of the curators' commands: a tetrahedron with a spoken text.
#pragma once

#include "tests/base/comes_true.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"
#include "tests/texts/wav_bytes.h"

#include <signal.h>

#include <string>

namespace frustumscreen::programs {

class CuratorFolder : public ProgramFolder {
protected:
    /// Writes a folder that bakes in a second.
    void put_jug(const std::string& name, const std::string& more = "") const {
        put(name + "/jug.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 1 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        put(name + "/artifact.toml", "scan = \"jug.obj\"\nsize = 16\n" + more);
    }
    void put_recording(const std::string& file) const {
        std::filesystem::create_directories((folder / file).parent_path());
        ASSERT_TRUE(write_file(folder / file, testing::wav16(testing::sine(0.5, 0.3))));
    }
    /// Starts one of the programs in the background, with its output in log.txt; returns its process.
    [[nodiscard]] pid_t start(const std::string& command) const {
        const int status =
            shell(fmt::format("{{ '{}'/{} >log.txt 2>&1 & echo $! >pid.txt; }}", bin_dir(), command));
        return status == 0 ? static_cast<pid_t>(std::stol(text("pid.txt"))) : 0;
    }
    /// True if the process runs; a zombie does not.
    [[nodiscard]] static bool runs(pid_t process) {
        const std::string stat = frustumscreen::text_of(fmt::format("/proc/{}/stat", process));
        return !stat.empty() && stat.find(") Z ") == std::string::npos;
    }
    [[nodiscard]] std::size_t count(const std::string& file, const std::string& part) const {
        const std::string all = text(file);
        std::size_t found = 0;
        for (std::size_t at = all.find(part); at != std::string::npos; at = all.find(part, at + 1)) {
            ++found;
        }
        return found;
    }
};

} // namespace frustumscreen::programs
