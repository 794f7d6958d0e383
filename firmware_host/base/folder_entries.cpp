#include "firmware_host/base/folder_entries.h"

#include <algorithm>

namespace frustumscreen {

FolderEntries entries_of(const std::filesystem::path& folder) {
    FolderEntries found;
    std::filesystem::directory_iterator at(folder, found.failed);
    for (; !found.failed && at != std::filesystem::directory_iterator(); at.increment(found.failed)) {
        found.entries.push_back(*at);
    }
    std::sort(found.entries.begin(), found.entries.end());
    return found;
}

} // namespace frustumscreen
