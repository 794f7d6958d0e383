#include "app/watch/service_ends.h"

#include "firmware_host/base/printable.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace frustumscreen::watch {

namespace {

constexpr std::size_t longest_word = 20;

std::string_view take_word(std::string_view& line) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t end = std::min(line.find(' ', begin), line.size());
    const std::string_view word = line.substr(begin, end - begin);
    line.remove_prefix(end);
    return word;
}

} // namespace

std::optional<ServiceEnd> parse_service_end(std::string_view line) {
    ServiceEnd end;
    const std::string_view time = take_word(line);
    const char* const after = time.data() + time.size();
    const std::from_chars_result read = std::from_chars(time.data(), after, end.monotonic_s);
    const std::string_view result = take_word(line);
    if (read.ec != std::errc{} || read.ptr != after || !std::isfinite(end.monotonic_s) || result.empty()) {
        return std::nullopt;
    }
    const auto* const known = std::find_if(service_results.begin(), service_results.end() - 1,
                                           [&](const ServiceResult& each) { return each.word == result; });
    end.result = static_cast<std::size_t>(known - service_results.begin());
    end.code = printable(take_word(line), longest_word);
    end.exit_status = printable(take_word(line), longest_word);
    return end;
}

std::uint64_t ServiceEnds::count() const {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

ServiceEnds parse_service_ends(std::string_view text) {
    ServiceEnds ends;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        if (std::optional<ServiceEnd> parsed = parse_service_end(text.substr(0, end))) {
            ++ends.counts.at(parsed->result);
            ends.last = std::move(parsed);
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return ends;
}

} // namespace frustumscreen::watch
