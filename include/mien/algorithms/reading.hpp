// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the mien authors

#pragma once

namespace mien {

/// How literally a paper's rule is taken: as written, or in the form that behaves on real faces (docs/papers/).
enum class Reading { paper, remedied };

}  // namespace mien
