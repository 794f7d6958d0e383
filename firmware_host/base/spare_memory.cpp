#include "firmware_host/base/spare_memory.h"

#include <malloc.h>

namespace frustumscreen {

void return_spare_memory() {
    malloc_trim(0);
}

} // namespace frustumscreen
