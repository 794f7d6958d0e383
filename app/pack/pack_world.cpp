#include "app/pack/pack_world.h"

namespace frustumscreen::pack {} // namespace frustumscreen::pack
