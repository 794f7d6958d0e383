"""The control socket: each line in is a command, each line out a JSON object. `tell` sends a command to a mock."""

import asyncio
import json
import os
import socket


def carry_out(execute, line):
    """`execute(line)` returns a dict or None, or raises ValueError with a sentence."""
    try:
        return {"ok": True, **(execute(line) or {})}
    except ValueError as error:
        return {"ok": False, "error": str(error)}


async def serve(path, execute):
    async def talk(reader, writer):
        try:
            while line := await reader.readline():
                answer = carry_out(execute, line.decode(errors="replace").strip())
                writer.write(json.dumps(answer).encode() + b"\n")
                await writer.drain()
        except (asyncio.CancelledError, ConnectionError):
            pass
        finally:
            writer.close()

    if os.path.exists(path):
        os.unlink(path)
    return await asyncio.start_unix_server(talk, path)


def tell(path, line, timeout_s=None):
    """Sends one command to a mock's socket and returns the answer as a dict; for other programs. None: waits as long as the mock lives."""
    with socket.socket(socket.AF_UNIX) as connection:
        connection.settimeout(timeout_s)
        connection.connect(path)
        connection.sendall(line.encode() + b"\n")
        with connection.makefile() as answers:
            if not (answer := answers.readline()):
                raise ConnectionError("it ended before it answered")
            return json.loads(answer)
