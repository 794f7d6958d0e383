#include "app/programs/watchdog/exhibit_status.h"

#include "firmware_host/base/json.h"

#include <algorithm>

namespace frustumscreen::programs {

namespace {

/// Streams the file without storing it: a status with a thousand packs takes no more memory than one with
/// none.
class Fields : public nlohmann::json_sax<nlohmann::json> {
public:
    ExhibitStatus status;
    bool has_health = false;

    bool null() override { return true; }
    bool boolean(bool value) override {
        if (is("asleep")) {
            status.says.asleep = value;
        } else if (is("tracker_hangs")) {
            status.says.device_hangs = value;
        }
        return true;
    }
    bool number_integer(number_integer_t /*value*/) override { return true; }
    bool number_unsigned(number_unsigned_t value) override {
        if (is("drawn") || is("probes")) {
            status.says.pictures += value;
        } else if (is("monotonic_ns")) {
            status.written_at =
                MonotonicTime(Nanoseconds(static_cast<Nanoseconds::rep>(std::min(value, max_ns))));
        }
        return true;
    }
    bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
    bool string(string_t& value) override {
        if (is("health")) {
            has_health = true;
            status.says.well = value == "well";
        } else if (is("boot_id")) {
            status.boot_id = value;
        } else if (is("artifact")) {
            status.says.artifacts = value.empty() ? 0 : 1;
        }
        return true;
    }
    bool binary(binary_t& /*value*/) override { return true; }
    bool start_object(std::size_t /*count*/) override { return ++depth_ < deepest; }
    bool end_object() override { return --depth_ >= 0; }
    bool start_array(std::size_t /*count*/) override { return ++depth_ < deepest; }
    bool end_array() override { return --depth_ >= 0; }
    bool key(string_t& name) override {
        key_ = name;
        return true;
    }
    bool parse_error(std::size_t /*place*/, const std::string& /*token*/,
                     const nlohmann::json::exception& /*error*/) override {
        return false;
    }

private:
    static constexpr int deepest = 16;
    static constexpr std::uint64_t max_ns = std::uint64_t{1} << 62U;
    [[nodiscard]] bool is(std::string_view name) const { return depth_ == 1 && key_ == name; }

    std::string key_;
    int depth_ = 0;
};

} // namespace

std::optional<ExhibitStatus> read_exhibit_status(std::string_view json) {
    Fields fields;
    const bool is_whole = nlohmann::json::sax_parse(json.begin(), json.end(), &fields);
    return is_whole && fields.has_health ? std::optional(fields.status) : std::nullopt;
}

} // namespace frustumscreen::programs
