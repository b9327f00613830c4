"""The command ``trackig``: whatever goes wrong, even while it loads, ends with an exit code of its own.

Code 1 says that a specification is not met, and Python's own code for a crash is 1 too: a script that calls
the command must be able to tell them apart.
"""

import sys
import traceback

CRASHED = 70
"""Exit code of an error of the program itself; EX_SOFTWARE of sysexits.h."""


def main(arguments=None):
    """Run one command.

    Parameters
    ----------
    arguments : list of str, optional
        Words of the command line; by default those of the process.

    Returns
    -------
    int
        Exit code.
    """
    try:
        # what is loaded here may fail as well
        from dashboard import cli

        return cli.main(arguments)
    except Exception:
        traceback.print_exc()
        sys.stderr.write("trackig: this is an error of trackig or its installation, not of the input\n")
        return CRASHED


if __name__ == "__main__":
    sys.exit(main())
