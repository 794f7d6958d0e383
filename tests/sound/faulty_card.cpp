// A sound card as an ALSA plugin: it consumes frames by the clock, and has underruns, suspensions and losses
// when set.
#include "tests/sound/faulty_card.h"

#include <alsa/asoundlib.h>
#include <alsa/pcm_external.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <chrono>
#include <memory>

extern "C" {
frustumscreen::testing::FaultyCard faulty_card;
}

namespace {

using Clock = std::chrono::steady_clock;

struct Card {
    snd_pcm_ioplug_t plugin{};
    Clock::time_point started;
    snd_pcm_uframes_t at = 0; ///< frames played since `started`
};

Card& card_of(snd_pcm_ioplug_t* plugin) {
    return *static_cast<Card*>(plugin->private_data);
}
/// Returns true once for each pending fault.
bool happens(std::atomic<int>& faults) {
    return faults > 0 && faults-- > 0;
}

int start(snd_pcm_ioplug_t* plugin) {
    card_of(plugin).started = Clock::now();
    card_of(plugin).at = 0;
    return 0;
}
int stop(snd_pcm_ioplug_t*) {
    return 0;
}

snd_pcm_sframes_t pointer(snd_pcm_ioplug_t* plugin) {
    Card& card = card_of(plugin);
    std::uint64_t ticks = 0;
    (void)!::read(plugin->poll_fd, &ticks, sizeof(ticks));
    if (faulty_card.gone) {
        ::snd_pcm_ioplug_set_state(plugin, SND_PCM_STATE_DISCONNECTED);
    } else if (plugin->state == SND_PCM_STATE_RUNNING) {
        if (happens(faulty_card.suspensions)) {
            ::snd_pcm_ioplug_set_state(plugin, SND_PCM_STATE_SUSPENDED);
            return static_cast<snd_pcm_sframes_t>(card.at % plugin->buffer_size);
        }
        const double seconds = std::chrono::duration<double>(Clock::now() - card.started).count();
        const auto due = static_cast<snd_pcm_uframes_t>(seconds * plugin->rate);
        if (due > plugin->appl_ptr || happens(faulty_card.underruns)) {
            return -EPIPE;
        }
        card.at = due;
    }
    return static_cast<snd_pcm_sframes_t>(card.at % plugin->buffer_size);
}

snd_pcm_sframes_t transfer(snd_pcm_ioplug_t*, const snd_pcm_channel_area_t*, snd_pcm_uframes_t,
                           snd_pcm_uframes_t frames) {
    faulty_card.frames += static_cast<long>(frames);
    return static_cast<snd_pcm_sframes_t>(frames);
}

int prepare(snd_pcm_ioplug_t* plugin) {
    card_of(plugin).at = 0;
    return faulty_card.gone ? -ENODEV : 0;
}

int resume(snd_pcm_ioplug_t* plugin) {
    if (happens(faulty_card.resumes_refused)) {
        return -EAGAIN;
    }
    ++faulty_card.resumed;
    card_of(plugin).started =
        Clock::now() - std::chrono::microseconds(1'000'000 * card_of(plugin).at / plugin->rate);
    ::snd_pcm_ioplug_set_state(plugin, SND_PCM_STATE_RUNNING);
    return 0;
}

int close(snd_pcm_ioplug_t* plugin) {
    ::close(plugin->poll_fd);
    delete &card_of(plugin);
    return 0;
}

const snd_pcm_ioplug_callback_t callbacks = [] {
    snd_pcm_ioplug_callback_t calls{};
    calls.start = start;
    calls.stop = stop;
    calls.pointer = pointer;
    calls.transfer = transfer;
    calls.prepare = prepare;
    calls.resume = resume;
    calls.close = close;
    return calls;
}();

int create(snd_pcm_t** pcm, const char* name, snd_pcm_stream_t stream, int mode) {
    if (faulty_card.gone) {
        return -ENODEV;
    }
    auto card = std::make_unique<Card>();
    snd_pcm_ioplug_t& plugin = card->plugin;
    plugin.version = SND_PCM_IOPLUG_VERSION;
    plugin.name = "a card with faults";
    plugin.callback = &callbacks;
    plugin.private_data = card.get();
    plugin.poll_events = POLLIN;
    plugin.poll_fd = ::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    const itimerspec every{{0, 5'000'000}, {0, 5'000'000}};
    ::timerfd_settime(plugin.poll_fd, 0, &every, nullptr);
    if (const int error = ::snd_pcm_ioplug_create(&plugin, name, stream, mode); error < 0) {
        ::close(plugin.poll_fd);
        return error;
    }
    (void)card.release(); // `close` deletes it
    const unsigned access = SND_PCM_ACCESS_RW_INTERLEAVED;
    const unsigned format = SND_PCM_FORMAT_S16_LE;
    ::snd_pcm_ioplug_set_param_list(&plugin, SND_PCM_IOPLUG_HW_ACCESS, 1, &access);
    ::snd_pcm_ioplug_set_param_list(&plugin, SND_PCM_IOPLUG_HW_FORMAT, 1, &format);
    ::snd_pcm_ioplug_set_param_minmax(&plugin, SND_PCM_IOPLUG_HW_CHANNELS, 2, 2);
    ::snd_pcm_ioplug_set_param_minmax(&plugin, SND_PCM_IOPLUG_HW_RATE, 48'000, 48'000);
    constexpr unsigned frame_bytes = 4;
    if (const unsigned bytes = frame_bytes * faulty_card.period; bytes > 0) {
        ::snd_pcm_ioplug_set_param_minmax(&plugin, SND_PCM_IOPLUG_HW_PERIOD_BYTES, bytes, bytes);
    }
    if (const unsigned bytes = frame_bytes * faulty_card.buffer; bytes > 0) {
        ::snd_pcm_ioplug_set_param_minmax(&plugin, SND_PCM_IOPLUG_HW_BUFFER_BYTES, bytes, bytes);
    }
    ++faulty_card.opened;
    *pcm = plugin.pcm;
    return 0;
}

} // namespace

extern "C" {
SND_PCM_PLUGIN_DEFINE_FUNC(faulty) {
    (void)root;
    (void)conf;
    return create(pcmp, name, stream, mode);
}
SND_PCM_PLUGIN_SYMBOL(faulty);
}
