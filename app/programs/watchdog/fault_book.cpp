#include "app/programs/watchdog/fault_book.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>

namespace frustumscreen::programs {

namespace {

std::string line_of(std::uint64_t number, const Fault& fault) {
    std::string line =
        fmt::format("{} {} awake {} s: {} -> {}{}{}", number, fault.at,
                    std::chrono::duration_cast<std::chrono::seconds>(fault.awake).count(),
                    fault.cause ? watch::word_of(*fault.cause) : "good_again", watch::word_of(fault.step),
                    fault.detail.empty() ? "" : "; ", fault.detail);
    std::replace_if(
        line.begin(), line.end(), [](char each) { return static_cast<unsigned char>(each) < ' '; }, ' ');
    line.resize(FaultBook::line_bytes - 1, ' ');
    return line + '\n';
}

/// The highest number at the beginning of a line; 0: there is none.
std::uint64_t latest_in(int descriptor) {
    std::uint64_t latest = 0;
    std::array<char, FaultBook::line_bytes> line{};
    for (std::uint64_t k = 0; k < FaultBook::max_lines; ++k) {
        if (::pread(descriptor, line.data(), line.size(), static_cast<off_t>(k * line.size())) !=
            std::ssize(line)) {
            break;
        }
        std::uint64_t number = 0;
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
        const bool is_in_place =
            error == std::errc{} && *end == ' ' && number > 0 && (number - 1) % FaultBook::max_lines == k;
        latest = is_in_place ? std::max(latest, number) : latest;
    }
    return latest;
}

} // namespace

FaultBook::FaultBook(const std::filesystem::path& file)
    : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (descriptor_.number() >= 0) {
        next_ = latest_in(descriptor_.number()) + 1;
    }
}

void FaultBook::enter(Fault fault) {
    waiting_.push_back(line_of(next_++, fault));
    if (!latest_.empty() && !latest_.back().helped && fault.cause) {
        latest_.back().helped = false;
    }
    latest_.push_back(std::move(fault));
    if (waiting_.size() > max_waiting) {
        waiting_.pop_front();
    }
    if (latest_.size() > max_latest) {
        latest_.pop_front();
    }
}

void FaultBook::note_good() {
    if (!latest_.empty() && !latest_.back().helped) {
        latest_.back().helped = true;
    }
}

void FaultBook::keep(MonotonicTime now, bool at_once) {
    const bool is_due = !written_at_ || now - *written_at_ >= between_writes || at_once;
    if (waiting_.empty() || !is_due || descriptor_.number() < 0) {
        return;
    }
    written_at_ = now;
    std::uint64_t number = next_ - waiting_.size();
    for (const std::string& line : waiting_) {
        const auto place = static_cast<off_t>((number++ - 1) % max_lines * line_bytes);
        if (::pwrite(descriptor_.number(), line.data(), line.size(), place) != std::ssize(line)) {
            return;
        }
    }
    if (::fdatasync(descriptor_.number()) == 0) {
        waiting_.clear();
    }
}

} // namespace frustumscreen::programs
