#include "firmware_host/panel/button_lines.h"
#include "firmware_host/panel/cp2112.h"

#include <fmt/format.h>
#include <gpiod.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <thread>

namespace frustumscreen::panel {

namespace {

struct CloseChip {
    void operator()(gpiod_chip* chip) const { ::gpiod_chip_close(chip); } // releases its lines too
};
using Chip = std::unique_ptr<gpiod_chip, CloseChip>;

tl::unexpected<Error> lost(MessageId id, std::string message) {
    return fail(ErrorKind::DeviceLost, id, std::move(message));
}

std::string reason(int error) {
    switch (error) {
    case EACCES:
    case EPERM:
        return "no permission; put the exhibit's user into the group gpio, or see its udev rule";
    case ENOENT:
    case ENODEV:
    case ENXIO:
        return "it is not there; is it plugged in, and its driver loaded?";
    case EBUSY:
        return "another program holds it; end that program";
    default:
        return std::strerror(error);
    }
}

gpiod_line* find(gpiod_chip* chip, const std::string& line) {
    unsigned offset = 0;
    const char* const end = line.data() + line.size();
    const auto [stop, error] = std::from_chars(line.data(), end, offset);
    return error == std::errc() && stop == end ? ::gpiod_chip_get_line(chip, offset)
                                               : ::gpiod_chip_find_line(chip, line.c_str());
}

Result<gpiod_line_bulk> find_all(gpiod_chip* chip, const std::vector<std::string>& names,
                                 const std::string& chip_name) {
    gpiod_line_bulk lines{};
    ::gpiod_line_bulk_init(&lines);
    for (const std::string& name : names) {
        gpiod_line* const line = find(chip, name);
        if (line == nullptr) {
            return lost("panel.no_line",
                        fmt::format("GPIO chip {} has no line {}; it has {} lines, and gpioinfo lists them",
                                    chip_name, name, ::gpiod_chip_num_lines(chip)));
        }
        ::gpiod_line_bulk_add(&lines, line);
    }
    return lines;
}

std::vector<unsigned> offsets_of(gpiod_line_bulk& lines) {
    std::vector<unsigned> offsets;
    for (unsigned k = 0; k < lines.num_lines; ++k) {
        offsets.push_back(::gpiod_line_offset(lines.lines[k]));
    }
    return offsets;
}

int flags_of(const LineRequest& request) {
    int flags = request.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
    switch (request.bias) {
    case LineBias::AsIs:
        return flags;
    case LineBias::PullUp:
        return flags | GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
    case LineBias::PullDown:
        return flags | GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
    case LineBias::Disabled:
        return flags | GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE;
    }
    return flags;
}

/// Interval of polling. Edge events are not used: Linux 6.1's hid-cp2112 sleeps in an atomic context when a
/// line with edges is released, which sometimes crashes the kernel. A finger is slower than this interval,
/// and reading three lines costs almost nothing.
constexpr Nanoseconds between_reads = std::chrono::milliseconds(20);

class GpiodLines final : public ButtonLines {
public:
    GpiodLines(Chip chip, std::string name, const gpiod_line_bulk& lines, const gpiod_line_bulk& lamps,
               std::string remark)
        : chip_(std::move(chip)), name_(std::move(name)), lines_(lines), lamps_(lamps),
          remark_(std::move(remark)) {}

    [[nodiscard]] Result<void> read(std::span<bool> down) override {
        std::array<int, GPIOD_LINE_BULK_MAX_LINES>
            levels{}; // lines requested together can only be read together
        if (::gpiod_line_get_value_bulk(&lines_, levels.data()) < 0) {
            return lost("panel.chip_lost", fmt::format("{}: {}", name_, reason(errno)));
        }
        std::transform(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(down.size()),
                       down.begin(), [](int level) { return level == 1; });
        return {};
    }

    [[nodiscard]] Result<void> wait(Nanoseconds timeout) override {
        std::this_thread::sleep_for(std::min(timeout, between_reads));
        return {};
    }

    [[nodiscard]] Result<void> light(std::span<const bool> lit) override {
        std::array<int, GPIOD_LINE_BULK_MAX_LINES> levels{};
        std::copy(lit.begin(), lit.end(), levels.begin());
        if (lamps_.num_lines > 0 && ::gpiod_line_set_value_bulk(&lamps_, levels.data()) < 0) {
            return lost("panel.lamps_lost", fmt::format("{}: its lamps: {}", name_, reason(errno)));
        }
        return {};
    }

    [[nodiscard]] std::string_view remark() const override { return remark_; }

private:
    Chip chip_;
    std::string name_;
    gpiod_line_bulk lines_;
    gpiod_line_bulk lamps_;
    std::string remark_;
};

} // namespace

Result<std::unique_ptr<ButtonLines>> open_gpio_lines(const LineRequest& request) {
    Chip chip(::gpiod_chip_open_lookup(request.chip.c_str()));
    if (!chip) {
        return lost("panel.chip_not_opened",
                    fmt::format("the buttons' GPIO chip {}: {}", request.chip, reason(errno)));
    }
    TRY(const auto lines, find_all(chip.get(), request.lines, request.chip));
    TRY(const auto lamps, find_all(chip.get(), request.lamps, request.chip));
    gpiod_line_bulk watched = lines;
    const gpiod_line_request_config config{"frustumscreen", GPIOD_LINE_REQUEST_DIRECTION_INPUT,
                                           flags_of(request)};
    if (::gpiod_line_request_bulk(&watched, &config, nullptr) < 0) {
        return lost("panel.lines_unreadable",
                    fmt::format("GPIO chip {}: its lines cannot be read: {}", request.chip, reason(errno)));
    }
    gpiod_line_bulk lit = lamps;
    const gpiod_line_request_config output{"frustumscreen", GPIOD_LINE_REQUEST_DIRECTION_OUTPUT, 0};
    const std::array<int, GPIOD_LINE_BULK_MAX_LINES> dark{};
    if (lit.num_lines > 0 && ::gpiod_line_request_bulk(&lit, &output, dark.data()) < 0) {
        return lost("panel.lamps_unlit",
                    fmt::format("GPIO chip {}: its lamps cannot be lit: {}", request.chip, reason(errno)));
    }
    std::string remark = cp2112_remark(request.chip, read_cp2112_configuration(::gpiod_chip_name(chip.get())),
                                       offsets_of(watched), offsets_of(lit));
    return std::make_unique<GpiodLines>(std::move(chip), "GPIO chip " + request.chip, watched, lit,
                                        std::move(remark));
}

} // namespace frustumscreen::panel
