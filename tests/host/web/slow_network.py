"""A network between the browser and the daemon that delays, stalls and cuts: a proxy for one port."""

import asyncio
import threading


class SlowNetwork:
    """`delay`: s for everything on its way; `stalled`: nothing gets through, and nobody notices; cut() ends what is open."""

    def __init__(self, port, target):
        self.port, self.target = port, target
        self.delay, self.stalled = 0.0, False
        self.accepted_since_cut = 0
        self.writers, self.server = set(), None
        self.loop = asyncio.new_event_loop()
        self.thread = threading.Thread(target=self.loop.run_forever, daemon=True)

    def __enter__(self):
        self.thread.start()
        listening = asyncio.start_server(self.take, "127.0.0.1", self.port)
        self.server = asyncio.run_coroutine_threadsafe(listening, self.loop).result()
        return self

    def __exit__(self, *_):
        async def end():
            self.server.close()
            while others := asyncio.all_tasks() - {asyncio.current_task()}:
                for one in others:
                    one.cancel()
                await asyncio.wait(others, timeout=1)
        asyncio.run_coroutine_threadsafe(end(), self.loop).result()
        self.loop.call_soon_threadsafe(self.loop.stop)
        self.thread.join()
        self.loop.close()

    def cut(self):
        def close():
            self.accepted_since_cut = 0
            for writer in list(self.writers):
                writer.transport.abort()
        self.loop.call_soon_threadsafe(close)

    async def take(self, reader, writer):
        self.accepted_since_cut += 1
        try:
            far_reader, far_writer = await asyncio.open_connection("127.0.0.1", self.target)
        except OSError:
            return writer.transport.abort()
        self.writers |= {writer, far_writer}
        await asyncio.gather(self.carry(reader, far_writer, True), self.carry(far_reader, writer, False))
        self.writers -= {writer, far_writer}

    async def carry(self, reader, writer, with_host):
        """The browser asks for this port, which is not the daemon's: the head of a request names the daemon's."""
        try:
            while piece := await reader.read(65536):
                if with_host:
                    piece = piece.replace(b"127.0.0.1:%d" % self.port, b"127.0.0.1:%d" % self.target)
                await asyncio.sleep(self.delay)
                while self.stalled:
                    await asyncio.sleep(0.02)
                writer.write(piece)
                await writer.drain()
        except (OSError, asyncio.CancelledError):
            pass
        finally:
            writer.transport.abort() if writer.is_closing() else writer.close()
