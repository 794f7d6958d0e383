/// libsndfile on bytes in memory.
///
/// Threads  one caller.
/// Library  libsndfile's virtual files.
#pragma once

#include "firmware_host/base/file.h"

#include <sndfile.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <span>

namespace frustumscreen::texts {

/// Read from `view`, or written to `written`.
struct SoundBytes {
    std::span<const std::byte> view;
    Bytes written;
    bool writing = false;
    sf_count_t cursor = 0;
    [[nodiscard]] sf_count_t size() const {
        return static_cast<sf_count_t>(writing ? written.size() : view.size());
    }
};

struct CloseSound {
    void operator()(SNDFILE* file) const { sf_close(file); }
};
using SoundFile = std::unique_ptr<SNDFILE, CloseSound>;

/// `bytes` must outlive the file. Null if the library refuses it; `sf_strerror(nullptr)` gives the reason.
[[nodiscard]] inline SoundFile open_sound(SoundBytes& bytes, int mode, SF_INFO& info) {
    SF_VIRTUAL_IO io{};
    io.get_filelen = [](void* of) { return static_cast<SoundBytes*>(of)->size(); };
    io.seek = [](sf_count_t offset, int whence, void* of) {
        auto& sound = *static_cast<SoundBytes*>(of);
        const sf_count_t from = whence == SEEK_CUR ? sound.cursor : whence == SEEK_END ? sound.size() : 0;
        sound.cursor = std::clamp<sf_count_t>(from + offset, 0, sound.size());
        return sound.cursor;
    };
    io.read = [](void* to, sf_count_t count, void* of) {
        auto& sound = *static_cast<SoundBytes*>(of);
        const sf_count_t read = std::clamp<sf_count_t>(count, 0, sound.size() - sound.cursor);
        if (read > 0 && !sound.writing) {
            std::memcpy(to, sound.view.data() + sound.cursor, static_cast<std::size_t>(read));
        } else if (read > 0) {
            std::memcpy(to, sound.written.data() + sound.cursor, static_cast<std::size_t>(read));
        }
        sound.cursor += read;
        return read;
    };
    io.write = [](const void* from, sf_count_t count, void* of) {
        auto& sound = *static_cast<SoundBytes*>(of);
        if (!sound.writing || count <= 0) {
            return sf_count_t{0};
        }
        const auto end = static_cast<std::size_t>(sound.cursor + count);
        sound.written.resize(std::max(sound.written.size(), end));
        std::memcpy(sound.written.data() + sound.cursor, from, static_cast<std::size_t>(count));
        sound.cursor += count;
        return count;
    };
    io.tell = [](void* of) { return static_cast<SoundBytes*>(of)->cursor; };
    return SoundFile(sf_open_virtual(&io, mode, &info, &bytes));
}

} // namespace frustumscreen::texts
