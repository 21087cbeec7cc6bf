# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the mien authors
"""The program mien, called from Python: what its fronts in Blender and Maya share. Standard library only."""
