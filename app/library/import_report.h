/// The importer's report on a stick, during and after the import: for the table, the journal and the status.
///
/// File     JSON, replaced by rename, at most a few times a second during a copy. It stays after the importer ends.
/// Threads  values; any.
/// Errors   one sentence: the bytes are no report.
#pragma once

#include "firmware_host/base/result.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::library {

enum class ImportStage : std::uint8_t {
    Found,      ///< a stick is there; its files are looked at
    Copying,    ///< `done_bytes` of `total_bytes`
    MayTakeOut, ///< reading from the stick has ended; the copies are checked and the set is switched
    Done,       ///< the new set can be shown, or nothing has changed
    Failed,     ///< the stick as a whole is refused: `refusal` and `reason`
};

inline constexpr std::array<std::string_view, 5> import_stage_names{"found", "copying", "may_take_out",
                                                                    "done", "failed"};

/// The outcome of a pack; Written and NotWritten are those of a report on the kiosk, which goes to the stick.
enum class ImportOutcome : std::uint8_t {
    Pending,
    Taken,
    AlreadyThere,
    Refused,
    Removed,
    Written,
    NotWritten
};
inline constexpr std::array<std::string_view, 7> import_outcome_names{
    "pending", "taken", "already_there", "refused", "removed", "written", "not_written"};

/// Why a pack or a stick was refused. The exhibit's own texts have `stick.refused.NAME` for each value.
enum class ImportRefusal : std::uint8_t {
    None,
    Unsigned,   ///< no signature
    WrongKey,   ///< signed with a key that is not one of the museum's, or that has expired
    Altered,    ///< signature, hash or checksum do not match
    Older,      ///< older than the installed one
    NotAPack,   ///< damaged, of unknown format, or beyond a limit
    NoRoom,     ///< the kiosk's disk is too full
    Unreadable, ///< the stick cannot be read, or was pulled out
    Unwritable, ///< the kiosk's disk cannot be written
    TooMuch,    ///< more files or folders than allowed, or too slow
};
inline constexpr std::array<std::string_view, 10> import_refusal_names{
    "none",       "unsigned", "wrong_key",  "altered",    "older",
    "not_a_pack", "no_room",  "unreadable", "unwritable", "too_much"};

struct ImportedPack {
    std::string file;  ///< its name on the stick, printable
    std::string title; ///< empty until the pack's signature is checked
    ImportOutcome outcome = ImportOutcome::Pending;
    ImportRefusal refusal = ImportRefusal::None;
    std::string reason; ///< a sentence
    [[nodiscard]] bool operator==(const ImportedPack&) const = default;
};
struct ImportReport {
    std::string import_id; ///< different for each stick that is put in
    std::string stick;     ///< its label, printable; may be empty
    ImportStage stage = ImportStage::Found;
    std::uint64_t done_bytes = 0, total_bytes = 0;
    ImportRefusal refusal = ImportRefusal::None;
    std::string reason;
    std::uint64_t set_number = 0; ///< of the installed set
    std::vector<ImportedPack> packs;
    [[nodiscard]] bool operator==(const ImportReport&) const = default;
};

[[nodiscard]] Result<ImportReport> parse_import_report(std::string_view json);
[[nodiscard]] std::string write_import_report(const ImportReport& report);

} // namespace frustumscreen::library
