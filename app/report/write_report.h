/// Writes the files of a report into a folder of their own on a stick.
///
/// Order    the space for all is looked for first. Each file is written under another name, synced and renamed; the
///          folder is synced last. Whenever the stick is pulled out, each file that has its name is whole.
/// Large    files are copied piece by piece from another folder, after the texts.
/// Others   no name is touched that the folder has already.
/// Threads  one caller.
/// Errors   one sentence for the table: no space, write-protected, pulled out.
#pragma once

#include "app/library/import_failure.h"
#include "firmware_host/base/file_tree.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::report {

struct ReportFile {
    std::string name;
    std::string text;
};

/// A file that is too large for the memory.
struct CopiedFile {
    std::string name;
    std::string source; ///< its path in CopiedFiles::from
    std::uint64_t bytes = 0;
};
struct CopiedFiles {
    FileTree* from = nullptr; ///< on the kiosk's disk
    std::vector<CopiedFile> files;
    std::function<void(std::uint64_t)> copied; ///< gets the bytes of each piece
};

/// `folder`: empty. If something fails, what was written is removed where that is possible.
[[nodiscard]] tl::expected<void, library::ImportFailure>
write_report(WritableTree& folder, std::span<const ReportFile> files, const CopiedFiles& large = {});

} // namespace frustumscreen::report
