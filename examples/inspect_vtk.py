"""Draw the stress of a run on its deformed discs: python examples/inspect_vtk.py out picture.png"""

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pyvista

folder, picture = Path(sys.argv[1]), sys.argv[2]

# fields.pvd collects the frames over the input angle; each frame holds one block per disc, in SI units
reader = pyvista.PVDReader(str(folder / "fields.pvd"))
discs = reader.read()
print(f"{len(reader.time_values)} frame(s), the first at {reader.time_values[0]:g} deg of the input angle")

moved = max(np.linalg.norm(disc["displacement"], axis=1).max() for disc in discs)
factor = 0.02 * discs.length / moved if moved > 0 else 1.0
# at the contacts stress is far above the rest: end the colours where 99.5 % of the area stay below
area = np.concatenate([disc.compute_cell_sizes()["Area"] for disc in discs])
stress = np.concatenate([disc.point_data_to_cell_data()["von_mises"] for disc in discs])
order = np.argsort(stress)
top = stress[order][np.searchsorted(np.cumsum(area[order]), 0.995 * area.sum())] / 1e6

plotter: Any = pyvista.Plotter(off_screen=True, window_size=[1500, 800], shape=(1, len(discs)), border=False)
plotter.set_background("white", all_renderers=True)
for column, disc in enumerate(discs):
    print(f"disc {column + 1}: {disc.n_points} nodes, largest stress {disc['von_mises'].max() / 1e6:.1f} MPa")
    disc["von Mises stress (MPa)"] = disc["von_mises"] / 1e6
    deformed = disc.warp_by_vector("displacement", factor=factor)
    # the triangles are quadratic: subdivide them, so that curved edges are drawn curved
    surface = deformed.extract_surface(nonlinear_subdivision=3, algorithm="dataset_surface")
    plotter.subplot(0, column)
    plotter.add_mesh(surface, scalars="von Mises stress (MPa)", clim=[0, top], cmap="viridis", lighting=False)
    plotter.add_text(f"disc {column + 1}, displacement x {factor:.0f}", font_size=9, color="black")
    plotter.view_xy()
plotter.screenshot(picture)
print(f"wrote {picture}")
