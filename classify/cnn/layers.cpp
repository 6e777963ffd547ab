// SPDX-License-Identifier: BSD-3-Clause
#include "classify/cnn/layers.h"

#include <dlfcn.h>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

using Maker = Layers* (*)(const LayerSizes&);  // seaglint_torch_layers

// From the folder of the program or PREFIX/lib/seaglint (the run path of what links this).
Maker load() {
  void* library = dlopen("libseaglint_layers.so", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw WorkError(std::string("network: cannot load libtorch: ") + dlerror());
  void* maker = dlsym(library, "seaglint_torch_layers");
  if (maker == nullptr) throw WorkError(std::string("network: ") + dlerror());
  return reinterpret_cast<Maker>(maker);
}

Maker maker() {
  static const Maker loaded = load();
  return loaded;
}

}  // namespace

void load_layers_library() { maker(); }

std::unique_ptr<Layers> make_layers(const LayerSizes& sizes) { return std::unique_ptr<Layers>(maker()(sizes)); }

}  // namespace seaglint
