#include "app/show/last_good_settings.h"

#include "firmware_host/base/file.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/service/watchdog_policy.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen::show {

namespace {

/// More than the largest allowed size of the settings.
constexpr std::uintmax_t max_bytes = 1U << 20U;

/// `as`: the file whose folder relative paths start from and whose name appears in messages.
Result<UsedSettings> read_from(const std::filesystem::path& file, const std::filesystem::path& as) {
    const Result<Bytes> bytes = read_file(file, max_bytes);
    if (!bytes) {
        return as_kind(ErrorKind::BadConfiguration, bytes.error());
    }
    std::string text(as_text(*bytes));
    TRY(settings::CheckedSettings settings, settings::kiosk_settings(text, as));
    return UsedSettings{std::move(settings), std::move(text), {}};
}

} // namespace

Result<UsedSettings> use_settings(const std::filesystem::path& file,
                                  const std::optional<SettingsFallback>& fallback) {
    Result<UsedSettings> own = read_from(file, file);
    if (own || !fallback) {
        return own;
    }
    const auto instead = [&](const std::filesystem::path& other, const std::filesystem::path& as,
                             std::string_view which) -> std::optional<UsedSettings> {
        Result<UsedSettings> used = other.empty() ? own : read_from(other, as);
        if (!used) {
            return std::nullopt;
        }
        used->instead =
            fmt::format("{}, {}, are used in their place: {}", which, other.string(), own.error().message);
        return std::move(*used);
    };
    std::optional<UsedSettings> used = instead(fallback->last_good, file, "the last good settings");
    if (!used) {
        used = instead(fallback->shipped, fallback->shipped, "the settings as shipped");
    }
    return used ? Result<UsedSettings>(std::move(*used)) : own;
}

SettingsKeeper::SettingsKeeper(std::filesystem::path file, std::string text)
    : file_(std::move(file)), text_(std::move(text)) {}

void SettingsKeeper::note(const RunStatus& status) {
    const MonotonicTime now = status.written.monotonic.value_or(MonotonicTime());
    const bool is_good = status.health == service::word_of(service::Health::Well) && !status.artifact.empty();
    if (!is_good || (since_ && now - latest_ > longest_silence)) {
        since_.reset();
    }
    latest_ = now;
    if (is_done_ || !is_good) {
        return;
    }
    since_ = since_ ? since_ : now;
    if (now - *since_ < long_enough) {
        return;
    }
    is_done_ = true;
    const Result<Bytes> kept = read_file(file_, max_bytes);
    if (kept && as_text(*kept) == text_) {
        return;
    }
    if (const Result<void> written = write_file(file_, as_bytes(text_)); !written) {
        say_line("frustumscreen", "the last good settings are not kept: " + written.error().message);
    }
}

} // namespace frustumscreen::show
