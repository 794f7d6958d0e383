/// The journal: one line for each change of state, with fields to search by (`journalctl DEVICE=tracker`). If
/// standard error is not the journal, the line goes there without its fields.
///
/// Threads  any; a line is one datagram, or one write.
/// Errors   none: without a reader the line is lost.
/// Source   JOURNAL_STREAM in systemd.exec(5); sd_journal_sendv(3).
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

struct stat;

namespace frustumscreen::service {

/// Levels of syslog(3).
enum class LogPriority { Error = 3, Warning = 4, Notice = 5, Info = 6 };

struct JournalField {
    std::string_view name; ///< capitals, digits, underscores
    std::string_view value;
};

class Journal {
public:
    /// `program` begins each line on standard error, and is the SYSLOG_IDENTIFIER in the journal.
    explicit Journal(std::string_view program);

    void note(LogPriority priority, std::string_view message,
              std::initializer_list<JournalField> fields = {}) const;

private:
    std::string program_;
    bool in_journal_;
};

/// `journal_stream` is the value of JOURNAL_STREAM, device:inode; null = not set.
[[nodiscard]] bool is_journal(const char* journal_stream, const struct stat& file);

} // namespace frustumscreen::service
