"""``trackig serve``: what it takes, where it listens, and what it says.

Nothing here loads the server itself, so that the command line stays quick.
"""

import errno
import ipaddress
import os
import socket
import sys
import webbrowser
from dataclasses import dataclass
from functools import partial
from pathlib import Path

PORT = 5006
"""Where the dashboard is served unless another port is given [-]."""

HERE = "127.0.0.1"
"""Address at which nobody else can reach the server."""

PAGE = "dashboard"
"""Last part of the page's address."""

BACKLOG = 128
"""Connections that may wait to be taken up."""

MOST_PASSWORD_BYTES = 1024


class ServeError(ValueError):
    """The dashboard cannot be served so; the message says why, and what can be done."""


@dataclass(frozen=True)
class Site:
    """Where the dashboard is served, and to whom.

    Attributes
    ----------
    address : str
        Address that is listened at.
    port : int
        Its port.
    prefix : str
        What stands before the page's name in its address, with a slash in front, or nothing.
    origins : tuple of str
        Hosts, with ports, whose pages may open a socket.
    password : str or None
        What visitors have to type, if anything.
    most_sessions : int or None
        Pages that may be open at a time, in each process; None: as many as usual.
    pages_ahead : int or None
        Pages that each process keeps ready; None: as many as usual.
    """

    address: str
    port: int
    prefix: str
    origins: tuple[str, ...]
    password: str | None
    most_sessions: int | None
    pages_ahead: int | None

    @property
    def path(self):
        """What follows host and port in the page's address."""
        return f"{self.prefix}/{PAGE}"


def add_arguments(command, number, port):
    """Add what ``trackig serve`` takes.

    Parameters
    ----------
    command : argparse.ArgumentParser
        The command.
    number, port : callable
        Read a whole number of one or more, and a port, or raise argparse.ArgumentTypeError.
    """
    command.add_argument("--port", type=port, default=PORT, help=f"1 to 65535, {PORT} unless given")
    command.add_argument(
        "--address",
        default=HERE,
        help="listen at this address of the machine; 0.0.0.0 opens the dashboard to the network "
        "(unless given: this machine only)",
    )
    command.add_argument("--prefix", default="", help="serve below this path, as behind a proxy")
    command.add_argument(
        "--allow-origin",
        action="append",
        default=[],
        metavar="HOST[:PORT]",
        help="let pages of this host open the dashboard, as a proxy's; may be given again",
    )
    command.add_argument(
        "--password-file", type=Path, metavar="FILE", help="ask visitors for the password in this text file"
    )
    command.add_argument("--processes", type=number, default=1, help="share visitors out among so many")
    command.add_argument(
        "--most-sessions", type=number, metavar="N", help="pages that may be open at a time, in each process"
    )
    command.add_argument(
        "--pages-ahead",
        type=number,
        metavar="N",
        help="pages that each process keeps ready for who comes next",
    )
    command.add_argument("--show", action="store_true", help="open the dashboard in a browser")


def serve(options):
    """Serve the dashboard until told to stop.

    Parameters
    ----------
    options : argparse.Namespace
        What :func:`add_arguments` read.

    Raises
    ------
    ServeError
        If the address cannot be listened at, or the password cannot be used; then nothing was served.
    OSError
        If the password cannot be read.
    """
    password = None if options.password_file is None else _password(options.password_file)
    if options.processes > 1 and not hasattr(os, "fork"):
        raise ServeError("--processes: this system can serve from one process only; leave the option out")
    listeners = _listen(options.address, options.port)
    prefix = "/" + options.prefix.strip("/") if options.prefix.strip("/") else ""
    hosts = reachable_hosts(options.address)
    site = Site(
        options.address,
        options.port,
        prefix,
        _origins(hosts, options.port, options.allow_origin),
        password,
        options.most_sessions,
        options.pages_ahead,
    )
    announce = partial(_announce, site, hosts, options.show)
    # the server is slow to load, and no other command needs it
    from dashboard.server import processes

    processes.run(site, listeners, options.processes, announce)


def _password(path):
    """Return the password in a file: its text without what ends the line."""
    with path.open("rb") as file:
        data = file.read(MOST_PASSWORD_BYTES + 1)
    try:
        text = data.decode("utf-8").rstrip("\r\n")
    except UnicodeDecodeError:
        raise ServeError(f"{path}: this is no text; write the password into it, in UTF-8") from None
    if not text.strip() or len(data) > MOST_PASSWORD_BYTES or "\n" in text:
        raise ServeError(f"{path}: write one line with the password, of at most {MOST_PASSWORD_BYTES} bytes")
    return text


def _listen(address, port):
    """Return sockets that listen at all addresses that a name stands for."""
    try:
        found = socket.getaddrinfo(address, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
    except (socket.gaierror, UnicodeError):
        raise ServeError(
            f"--address {address}: this machine knows no such address; leave it out, or give one of its own"
        ) from None
    listeners = []
    try:
        for family, *_, place in dict.fromkeys(found):
            listener = socket.socket(family, socket.SOCK_STREAM)
            listeners.append(listener)
            if os.name == "posix":
                # elsewhere it would let two servers share a port
                listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            if family == socket.AF_INET6:
                listener.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, 1)
            listener.setblocking(False)
            listener.bind(place)
            listener.listen(BACKLOG)
    except OSError as error:
        for listener in listeners:
            listener.close()
        raise ServeError(_refusal(address, port, error)) from None
    return listeners


def _refusal(address, port, error):
    match error.errno:
        case errno.EADDRINUSE:
            return f"port {port} is in use: stop what is served there, or give another with --port"
        case errno.EADDRNOTAVAIL:
            return (
                f"--address {address}: this machine has no such address; leave it out, or give one of its own"
            )
        case errno.EACCES:
            return f"port {port} needs rights that you do not have: give another with --port, such as {PORT}"
    return f"{address}, port {port}: {error.strerror}"


def reachable_hosts(address):
    """Return by what names or addresses others can type a server that listens at an address.

    Parameters
    ----------
    address : str
        What is listened at.

    Returns
    -------
    tuple of str
        ``localhost`` for this machine only; for all addresses, those of the machine and its name.
    """
    try:
        number = ipaddress.ip_address(address)
    except ValueError:
        return (address,)
    if number.is_loopback:
        return ("localhost",)
    if not number.is_unspecified:
        return (_bracketed(address),)
    family = socket.AF_INET6 if number.version == 6 else socket.AF_INET
    return tuple(dict.fromkeys([*_own_addresses(family), socket.gethostname()]))


def _own_addresses(family):
    """Return addresses of this machine that are not for itself alone."""
    found = []
    # where a message to elsewhere would leave; none is sent
    elsewhere = ("192.0.2.1", 9) if family == socket.AF_INET else ("2001:db8::1", 9)
    try:
        with socket.socket(family, socket.SOCK_DGRAM) as probe:
            probe.connect(elsewhere)
            found.append(probe.getsockname()[0])
        found += [place[0] for *_, place in socket.getaddrinfo(socket.gethostname(), None, family)]
    except OSError:
        # a machine without a network has its name, which may do once it has one
        pass
    return [_bracketed(each) for each in dict.fromkeys(found) if not ipaddress.ip_address(each).is_loopback]


def _bracketed(address):
    return f"[{address}]" if ":" in address else address


def _origins(hosts, port, allowed):
    """Return hosts, with ports, whose pages may open a socket."""
    own = [f"{host}:{port}" for host in dict.fromkeys(["localhost", HERE, *hosts])]
    return tuple(own + [each.split("://")[-1].rstrip("/").lower() for each in allowed])


def _announce(site, hosts, show):
    """Say where the dashboard is served, and to whom."""
    urls = [f"http://{host}:{site.port}{site.path}" for host in hosts]
    if hosts == ("localhost",):
        whom = "to this machine only (--address 0.0.0.0 opens it to the network)"
    else:
        whom = "to the network, " + ("without a password" if site.password is None else "behind a password")
    sys.stdout.write(f"trackig: serving at {' and '.join(urls)}, {whom}; press Ctrl+C to stop\n")
    sys.stdout.flush()
    if show:
        webbrowser.open(urls[0])
