"""Writes the NumPy archives of this folder, with which the reader of raw problems is tested.

    python write_npz.py

NumPy itself is the reference here: nothing of slideway takes part. Archives come out the same up to the bytes of the
compressed parts; run it only to add one.
"""

from pathlib import Path

import numpy as np

HERE = Path(__file__).parent / "npz"
M = np.array([[1.0, 2.0, 0.0], [0.0, 1.0, 2.0], [2.0, 0.0, 1.0]])
q = np.array([-1.0, -2.0, -4.0])

# One problem in many forms: every file has the same answer.
np.savez(HERE / "plain.npz", M=M, q=q)
np.savez_compressed(HERE / "compressed.npz", type="lcp", M=M, q=q)
np.savez(HERE / "fortran.npz", type=b"lcp", M=np.asfortranarray(M), q=q)
np.savez(HERE / "float32.npz", M=M.astype("f4"), q=q.astype("f4"))
np.savez(HERE / "big-endian.npz", type=np.array("lcp", dtype=">U3"), M=M.astype(">f8"), q=q.astype(">i4"))
np.savez(HERE / "integers.npz", M=M.astype("u1"), q=q.astype("i8"))
np.savez(HERE / "column.npz", M=M, q=q.reshape(3, 1))

# Bad ones.
np.savez(HERE / "bad-complex.npz", M=M.astype(complex), q=q)
np.savez(HERE / "bad-object.npz", M=M.astype(object), q=q)
np.savez(HERE / "bad-shape.npz", M=M[:2], q=q)
np.savez(HERE / "bad-three-dimensions.npz", M=M.reshape(3, 3, 1), q=q)
np.savez(HERE / "bad-nan.npz", M=np.where(M == 2.0, np.nan, M), q=q)
np.savez(HERE / "bad-names.npz", A=M, p=q)
np.savez(HERE / "bad-type.npz", type=3, M=M, q=q)
np.savez(HERE / "bad-empty.npz")
(HERE / "bad-truncated.npz").write_bytes((HERE / "plain.npz").read_bytes()[:300])
