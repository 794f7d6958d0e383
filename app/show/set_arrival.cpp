#include "app/show/set_arrival.h"

#include "firmware_host/base/device_thread.h"

#include <utility>

namespace frustumscreen::show {

SetArrival::SetArrival(std::filesystem::path library, const std::optional<FileStamp>& before)
    : thread_([this, folder = std::move(library), before](const std::stop_token& stop) {
          begin_device_thread("arrival");
          while (!stop.stop_requested() && !came_) {
              const std::optional<FileStamp> now = stamp_of_set(folder);
              came_ = now && now != before;
              sleep_until_stop(stop, between_looks);
          }
      }) {}

} // namespace frustumscreen::show
