#include "app/programs/watchdog/memory_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <string>

namespace frustumscreen::programs {

namespace {

constexpr std::size_t file_bytes = watch::slot_count * watch::slot_bytes;

std::string content_of_file(int descriptor) {
    std::string content(file_bytes, '\0');
    const ssize_t read = ::pread(descriptor, content.data(), content.size(), 0);
    content.resize(read > 0 ? static_cast<std::size_t>(read) : 0);
    return content;
}

bool write_all(int descriptor, std::string_view bytes, std::size_t offset) {
    const ssize_t written = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    return written == std::ssize(bytes) && ::fdatasync(descriptor) == 0;
}

bool differ_in_more_than_time(watch::LadderMemory a, const watch::LadderMemory& b) {
    a.awake = b.awake;
    return !(a == b);
}

} // namespace

MemoryFile::MemoryFile(const std::filesystem::path& file, std::uint64_t boot)
    : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)), boot_(boot) {
    if (descriptor_.number() < 0) {
        return;
    }
    const std::string content = content_of_file(descriptor_.number());
    kept_ = watch::read_slots(content);
    if (content.size() < file_bytes) { // allocate its blocks now, while the disk has space
        write_all(descriptor_.number(), std::string(file_bytes - content.size(), ' '), content.size());
    }
}

watch::LadderMemory MemoryFile::remembered(watch::Awake since_boot) const {
    watch::LadderMemory fresh;
    fresh.awake = since_boot;
    return kept_ ? frustumscreen::watch::remembered(*kept_, boot_, since_boot) : fresh;
}

bool MemoryFile::can_write_now(MonotonicTime now) const {
    return descriptor_.number() >= 0 && !has_failed_ && (!tried_at_ || now - *tried_at_ >= between_writes);
}

bool MemoryFile::keep(MonotonicTime now, watch::Awake since_boot, const watch::LadderMemory& memory,
                      bool at_once) {
    const Nanoseconds since = tried_at_ ? now - *tried_at_ : longest_between_writes;
    const bool is_due =
        since >= longest_between_writes ||
        (since >= between_writes && (!kept_ || differ_in_more_than_time(kept_->memory, memory)));
    if (descriptor_.number() < 0 || (!is_due && !at_once)) {
        return false;
    }
    tried_at_ = now;
    const watch::KeptMemory next{
        .writes = kept_ ? kept_->writes + 1 : 1, .boot = boot_, .since_boot = since_boot, .memory = memory};
    has_failed_ = !write_all(descriptor_.number(), watch::slot_of(next),
                             next.writes % watch::slot_count * watch::slot_bytes);
    if (!has_failed_) {
        kept_ = next;
    }
    return !has_failed_;
}

} // namespace frustumscreen::programs
