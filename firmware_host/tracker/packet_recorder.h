/// Writes a tracker's packets into a recording while the exhibit runs.
///
/// Threads  `packet` on the device's thread: it copies into a bounded queue and returns. The file is written
///          on the class's own thread, and made safe against a power cut once a second. The rest: any.
/// Errors   none to the caller. A disk that is too slow makes gaps, which the recording itself and `state`
///          name; one that is full, or gone, ends the recording, and `state` says so.
/// Memory   twice `most_waiting_bytes`, allocated at the beginning.
#pragma once

#include "firmware_host/base/growing_file.h"
#include "firmware_host/base/sentence.h"
#include "firmware_host/tracker/packet_file.h"

#include <mutex>
#include <stop_token>
#include <thread>

namespace frustumscreen {

class PacketRecorder final : public PacketTap {
public:
    /// Enough for minutes of any device.
    static constexpr std::size_t most_waiting_bytes = std::size_t{4} << 20;

    /// `about`: which program records, and when.
    PacketRecorder(GrowingFile file, std::string_view about, MonotonicTime now);

    void packet(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload) override;
    /// The recording's state in one sentence, valid until the next call. The number of missing packets
    /// changes in it only when it has doubled, so that it can go to a journal at each change.
    [[nodiscard]] std::string_view state();
    /// Takes nothing more, writes what waits and syncs it; it does not close the file. Errors: what ended the
    /// recording.
    [[nodiscard]] Result<void> finish();

    struct Counts {
        std::uint64_t packets = 0; ///< taken into the recording
        std::uint64_t dropped = 0; ///< found no room
    };
    [[nodiscard]] Counts counts() const;
    [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }

private:
    void write(const std::stop_token& stop);
    // With the lock held.
    [[nodiscard]] bool has_room(std::size_t payload) const;
    void take(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload);
    void name_gap(MonotonicTime time);
    void say();

    GrowingFile file_; ///< the writing thread only, but for its name
    mutable std::mutex mutex_;
    Bytes waiting_;
    Counts counts_;
    std::uint64_t gap_ = 0;   ///< dropped since the last packet that was taken
    MonotonicTime gap_until_; ///< the last of them
    bool finished_ = false;   ///< nothing more is taken
    std::optional<Error> ended_;
    Sentence said_;       ///< of the caller of `state`
    std::jthread thread_; ///< last: it uses all of the above
};

} // namespace frustumscreen
