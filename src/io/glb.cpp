// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#include "io/glb.hpp"
