/// Makes Mesa draw with the least that can go wrong in a graphics driver: the processor draws, in one thread, with vectors of 128
/// bits and instructions that every x86-64 PC of the last fifteen years has, and no compiled shader is taken from a disk.
///
/// Threads  while there is one thread and no display yet; Mesa reads the environment.
/// Source   Mesa 22.3, docs/envvars.rst; GBM_ALWAYS_SOFTWARE: src/gbm/backends/dri/gbm_dri.c.
#pragma once

namespace frustumscreen {

void draw_plainly();

} // namespace frustumscreen
