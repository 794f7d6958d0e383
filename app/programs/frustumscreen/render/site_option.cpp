#include "app/programs/frustumscreen/render/site_option.h"

#include "app/world/site_view.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>

namespace frustumscreen::programs {

namespace {

std::optional<show::OfflineSite> read_site(const std::string& text) {
    std::array<double, 3> numbers{};
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const std::from_chars_result read = std::from_chars(at, end, numbers[k]);
        const bool is_last = k + 1 == numbers.size();
        if (read.ec != std::errc{} || (is_last ? read.ptr != end : read.ptr == end || *read.ptr != ',')) {
            return std::nullopt;
        }
        at = is_last ? read.ptr : read.ptr + 1;
    }
    const auto on_site = [](double place) { return place >= -0.5 && place <= 0.5; };
    if (!on_site(numbers[0]) || !on_site(numbers[1]) || !(numbers[2] >= 1.0) ||
        !(numbers[2] <= world::max_zoom)) {
        return std::nullopt;
    }
    return show::OfflineSite{.place_box = {numbers[0], numbers[1]}, .zoom = numbers[2]};
}

} // namespace

ArgumentCheck is_site() {
    const auto check = [](const std::string& text) {
        return read_site(text)
                   ? std::string()
                   : fmt::format("'{}' is not a part of a site; allowed is X,Y,ZOOM: a place, -0.5 "
                                 "to 0.5, in lengths of the site's "
                                 "longer side from its middle, and how many times larger than "
                                 "the miniature, 1 to {:g}, such as "
                                 "0.1,-0.2,4",
                                 text, world::max_zoom);
    };
    return {check, ""};
}

show::OfflineSite site_in(const std::string& text) {
    return read_site(text).value();
}

} // namespace frustumscreen::programs
