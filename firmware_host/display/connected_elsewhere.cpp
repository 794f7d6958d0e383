#include "firmware_host/display/connected_elsewhere.h"

#include "firmware_host/base/folder_entries.h"

#include <algorithm>
#include <fstream>

namespace frustumscreen::display {

std::vector<std::string> connected_connectors(const std::filesystem::path& folder) {
    std::vector<std::string> connected;
    for (const std::filesystem::directory_entry& entry : entries_of(folder)) {
        std::string status;
        if (std::ifstream file(entry.path() / "status"); file >> status && status == "connected") {
            connected.push_back(entry.path().filename().string());
        }
    }
    return connected;
}

bool has_connected(std::span<const std::string> connected, const std::filesystem::path& card,
                   std::string_view connector) {
    const std::string first = card.filename().string() + "-";
    return std::any_of(connected.begin(), connected.end(), [&](const std::string& one) {
        return one.starts_with(first) && (connector.empty() || one.substr(first.size()) == connector);
    });
}

} // namespace frustumscreen::display
