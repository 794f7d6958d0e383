/// Writes the files of a report into a folder of their own on a stick.
///
/// Order    the room for all is looked for first. Each file is written under another name, synced and renamed; the
///          folder is synced last. Whenever the stick is pulled out, each file that has its name is whole.
/// Others   no name is touched that the folder has already.
/// Threads  one caller.
/// Errors   one sentence for the table: no room, write-protected, pulled out.
#pragma once

#include "app/library/import_failure.h"
#include "firmware_host/base/file_tree.h"

#include <span>
#include <string>

namespace frustumscreen::report {

struct ReportFile {
    std::string name;
    std::string text;
};

/// `folder`: empty. If something fails, what was written is removed where that is possible.
[[nodiscard]] tl::expected<void, library::ImportFailure> write_report(WritableTree& folder,
                                                                      std::span<const ReportFile> files);

} // namespace frustumscreen::report
