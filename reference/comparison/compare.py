#!/usr/bin/env python3
"""Compares slideway with other codes on the same instances and writes the tables of the book.

    python3 reference/comparison/compare.py            about 30 minutes
    python3 reference/comparison/compare.py --quick    about 3 minutes, smaller instances
    python3 reference/comparison/compare.py --quick --families degenerate monotone chained

Makes what it needs first: Siconos from Debian's packages (asks apt-get if it is not installed, which needs root), a
virtual environment with NumPy and HiGHS, two small C programs, and the Rust example `compare`. Everything but the
tables goes to target/comparison. Run it on an idle machine.
"""
import argparse
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SICONOS = "libsiconos-numerics-dev"
LAPACK = "liblapack-dev"


def output_of(*command):
    """What a command prints, or nothing if it fails or is absent."""
    if shutil.which(command[0]) is None:
        return ""
    return subprocess.run(command, capture_output=True, text=True).stdout.strip()


def package_version(package):
    """The installed version of a Debian package, or nothing."""
    return output_of("dpkg-query", "-W", "-f", "${Version}", package)


def install_packages(packages):
    """Installs those Debian packages that are missing."""
    missing = [package for package in packages if not package_version(package)]
    if not missing:
        return
    if shutil.which("apt-get") is None or os.geteuid() != 0:
        sys.exit(f"please install {' '.join(missing)} (Debian's names)")
    subprocess.run(["apt-get", "update"], check=True, stdout=subprocess.DEVNULL)
    command = ["apt-get", "install", "--yes", "--no-install-recommends", *missing]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def python_environment(folder):
    """A virtual environment with NumPy and HiGHS; returns its interpreter."""
    python = folder / "venv" / "bin" / "python"
    if not python.exists():
        venv.create(folder / "venv", with_pip=True)
    subprocess.run([python, "-m", "pip", "install", "--quiet", "-r", HERE / "requirements.txt"], check=True)
    return python


def compile_rivals(folder):
    """Compiles the two C programs."""
    compiler = ["gcc", "-O2", "-march=native", "-Wall", "-Wextra"]
    siconos = ["-isystem", "/usr/include/siconos", "-isystem", "/usr/include/siconos/numerics", "-lsiconos_numerics"]
    for name, options in (("lcp_enum", siconos), ("lu_patterns", ["-llapack", "-lm"])):
        source = HERE / f"{name}.c"
        subprocess.run([*compiler, source, "-o", folder / name, *options], check=True)


def build_slideway():
    """Builds the Rust example; returns its path."""
    command = ["cargo", "build", "--release", "--locked", "--quiet", "-p", "slideway", "--example", "compare"]
    subprocess.run(command, check=True, cwd=ROOT)
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    return target / "release" / "examples" / "compare"


def first_match(pattern, path):
    """The first group of a pattern in a file, or "unknown"."""
    match = re.search(pattern, path.read_text()) if path.exists() else None
    return match[1].strip() if match else "unknown"


def versions(python):
    """The machine and the versions of all codes, in words."""
    installed = json.loads(output_of(str(python), "-m", "pip", "list", "--format", "json") or "[]")
    packages = {package["name"]: package["version"] for package in installed}
    memory = int(first_match(r"MemTotal:\s*(\d+)", Path("/proc/meminfo"))) / 2**20
    commit = output_of("git", "-C", str(ROOT), "rev-parse", "--short", "HEAD")
    changed = output_of("git", "-C", str(ROOT), "status", "--porcelain", "--untracked-files=no")
    return {
        "processor": first_match(r"model name\s*:\s*(.*)", Path("/proc/cpuinfo")),
        "cores": f"{os.cpu_count()}",
        "memory": f"{memory:.0f} GiB",
        "system": first_match(r'PRETTY_NAME="(.*)"', Path("/etc/os-release")),
        "slideway": f"commit {commit}{' with changes' if changed else ''}, {output_of('rustc', '--version').split(' (')[0]}",
        "Siconos": package_version(SICONOS),
        "LAPACK": "OpenBLAS " + (package_version("libopenblas0-pthread") or "?"),
        "HiGHS": packages.get("highspy", "?"),
        "NumPy": packages.get("numpy", "?"),
        "Python": platform.python_version(),
        "gcc": output_of("gcc", "-dumpfullversion"),
    }


def parse_arguments():
    """The arguments of the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="smaller instances and limits, about 3 minutes")
    parser.add_argument("--limit", type=float, help="seconds for a search or for HiGHS on one instance (120; 15)")
    parser.add_argument("--pattern-limit", type=float, help="seconds for trying every pattern (60; 5)")
    parser.add_argument("--ladder-limit", type=float, help="seconds for the largest instance of a family (60; 5)")
    parser.add_argument("--families", nargs="+", default=[], help="only those whose name begins with one of these words")
    parser.add_argument("--threads", type=int, default=1, help="threads of slideway and of LAPACK (1)")
    parser.add_argument("--output", type=Path, help="the Markdown file to write")
    return parser.parse_args()


def main():
    """Makes everything and measures."""
    arguments = parse_arguments()
    folder = ROOT / "target" / "comparison"
    folder.mkdir(parents=True, exist_ok=True)
    install_packages([SICONOS, LAPACK, "gcc"])
    python = python_environment(folder)
    compile_rivals(folder)
    program = build_slideway()
    quick = arguments.quick
    default = folder / "quick.md" if quick or arguments.families else ROOT / "reference" / "comparison" / "tables.md"
    options = {
        "--folder": folder,
        "--slideway": program,
        "--output": arguments.output or default,
        "--versions": json.dumps(versions(python)),
        "--limit": arguments.limit or (15 if quick else 120),
        "--pattern-limit": arguments.pattern_limit or (5 if quick else 60),
        "--ladder-limit": arguments.ladder_limit or (5 if quick else 60),
        "--threads": arguments.threads,
    }
    words = [str(word) for option in options.items() for word in option]
    environment = os.environ | {"OPENBLAS_NUM_THREADS": str(arguments.threads)}
    words += ["--quick"] if quick else []
    words += ["--families", *arguments.families] if arguments.families else []
    command = [python, HERE / "measure.py", *words]
    sys.exit(subprocess.run(command, env=environment).returncode)


if __name__ == "__main__":
    main()
