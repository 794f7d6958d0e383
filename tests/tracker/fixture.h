/// Byte sequences in tests/tracker/fixtures, by name. They were made independently; the mocks' tests read
/// them too.
#pragma once

#include "firmware_host/base/file.h"
#include "tests/folders.h"
#include "tests/tracker/wire_bytes.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>

namespace frustumscreen::wire {

class Fixture {
public:
    explicit Fixture(const std::string& file) {
        const Result<Bytes> bytes = read_file(source_dir() + "/tests/tracker/fixtures/" + file);
        std::istringstream lines(bytes ? std::string(as_text(*bytes)) : std::string());
        std::string name;
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with(' ')) {
                const Wire more = from_hex(line);
                frames_[name].insert(frames_[name].end(), more.begin(), more.end());
            } else if (!line.starts_with('#')) {
                name = line;
            }
        }
    }
    [[nodiscard]] Wire operator[](const std::string& name) const {
        const auto found = frames_.find(name);
        if (found == frames_.end()) {
            ADD_FAILURE() << "no fixture is called " << name;
            return {};
        }
        return found->second;
    }

private:
    std::map<std::string, Wire> frames_;
};

} // namespace frustumscreen::wire
