/// Collects the first of the errors that a check of settings finds.
///
/// Threads  one caller.
#pragma once

#include "app/settings/table_reader.h"
#include "firmware_host/base/result.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::settings {

class Fitness {
public:
    Fitness(const std::string& file, const KeyLines& lines) : file_(file), lines_(lines) {}

    void require(MessageId id, bool well, std::string_view key, const std::string& what) {
        if (well || error_) {
            return;
        }
        const auto line = lines_.find(key);
        error_ =
            Error{ErrorKind::BadConfiguration, id,
                  located(file_, line != lines_.end() ? line->second : 0, fmt::format("{} {}", key, what))};
    }
    [[nodiscard]] bool names(std::string_view key) const { return lines_.find(key) != lines_.end(); }
    [[nodiscard]] const std::optional<Error>& error() const { return error_; }

private:
    const std::string& file_;
    const KeyLines& lines_;
    std::optional<Error> error_;
};

} // namespace frustumscreen::settings
