// Without this the journal names this file as the source of every line.
#define SD_JOURNAL_SUPPRESS_LOCATION

#include "firmware_host/service/journal.h"

#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <systemd/sd-journal.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cstdlib>

namespace frustumscreen::service {

namespace {

constexpr std::size_t longest_value = 240;

/// A line's fields, consecutive in memory of fixed size; an overlong line is cut.
class Entry {
public:
    void add(std::string_view name, std::string_view value) {
        assert(count_ < parts_.size());
        char* const begin = text_.data() + used_;
        const std::size_t free = text_.size() - used_;
        const auto end = fmt::format_to_n(begin, free, "{}={}", name, value).out;
        const auto size = static_cast<std::size_t>(end - begin);
        parts_.at(count_++) = {begin, size};
        used_ += size;
    }
    void send() const { ::sd_journal_sendv(parts_.data(), static_cast<int>(count_)); }

private:
    std::array<char, 4096> text_{};
    std::array<iovec, 10> parts_{};
    std::size_t used_ = 0;
    std::size_t count_ = 0;
};

} // namespace

bool is_journal(const char* journal_stream, const struct stat& file) {
    if (journal_stream == nullptr) {
        return false;
    }
    return fmt::format("{}:{}", file.st_dev, file.st_ino) == journal_stream;
}

Journal::Journal(std::string_view program) : program_(program), in_journal_(false) {
    struct stat file {};
    in_journal_ = ::fstat(STDERR_FILENO, &file) == 0 && is_journal(std::getenv("JOURNAL_STREAM"), file);
}

void Journal::note(LogPriority priority, std::string_view message,
                   std::initializer_list<JournalField> fields) const {
    if (!in_journal_) {
        say_line(program_, message);
        return;
    }
    Entry entry;
    entry.add("PRIORITY", std::to_string(static_cast<int>(priority)));
    entry.add("SYSLOG_IDENTIFIER", program_);
    for (const JournalField& field : fields) {
        entry.add(field.name, field.value.substr(0, longest_value));
    }
    entry.add("MESSAGE", message); // last: it takes the remaining space
    entry.send();
}

} // namespace frustumscreen::service
