/// Writes a tracker's packets into a recording while the exhibit runs.
///
/// Threads  `packet` on the device's thread: it copies into a bounded queue and returns. The class's own
///          thread writes the file and syncs it once a second. Everything else: any thread.
/// Errors   none to the caller. A disk that is too slow causes gaps; the recording and `state` report them. A
///          full or lost disk ends the recording; `state` says so.
/// Memory   twice `max_waiting_bytes`, allocated at the beginning.
#pragma once

#include "firmware_host/base/growing_file.h"
#include "firmware_host/base/sentence.h"
#include "firmware_host/tracker/packet_file.h"

#include <mutex>
#include <stop_token>
#include <thread>

namespace frustumscreen::tracker {

class PacketRecorder final : public PacketTap {
public:
    /// Holds minutes of any device.
    static constexpr std::size_t max_waiting_bytes = std::size_t{4} << 20;

    /// `about` names the recording program and the time.
    PacketRecorder(GrowingFile file, std::string_view about, MonotonicTime now);

    void packet(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload) override;
    /// The recording's state in one sentence, valid until the next call. The number of missing packets
    /// changes in it only when it has doubled, so each change can go to a journal.
    [[nodiscard]] std::string_view state();
    /// Takes no more packets, writes the queue and syncs the file, but does not close it. Errors: the one
    /// that ended the recording.
    [[nodiscard]] Result<void> finish();

    struct Counts {
        std::uint64_t packets = 0; ///< taken into the recording
        std::uint64_t dropped = 0; ///< did not fit into the queue
    };
    [[nodiscard]] Counts counts() const;
    [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }

private:
    void write(const std::stop_token& stop);
    // Call with the lock held.
    [[nodiscard]] bool has_space(std::size_t payload) const;
    void take(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload);
    void name_gap(MonotonicTime time);
    void say();

    GrowingFile file_; ///< the writing thread only, except for its name
    mutable std::mutex mutex_;
    Bytes waiting_;
    Counts counts_;
    std::uint64_t gap_ = 0;   ///< packets dropped since the last one taken
    MonotonicTime gap_until_; ///< time of the last dropped packet
    bool finished_ = false;   ///< no more packets are taken
    std::optional<Error> ended_;
    Sentence said_;       ///< used by the caller of `state` only
    std::jthread thread_; ///< last: it uses all members above
};

} // namespace frustumscreen::tracker
