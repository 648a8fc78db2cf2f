// How fast points are drawn on this machine, so that moving stays smooth on any.
const kMoving_ms = 40; // for a picture of a moving camera
const kResting_ms = 500;

export class Pace {
  busy = false; // the last picture is still being drawn
  slow = false; // a sharp picture takes too long for a moving camera
  private speed = 20_000; // points a millisecond

  budget(moving: boolean): number {
    return moving ? Math.max(this.speed * kMoving_ms, 60_000) : Math.max(this.speed * kResting_ms, 600_000);
  }

  // Waits for the picture that was begun at `start`, without holding the page up.
  measure(gl: WebGL2RenderingContext, picture: { start: number; points: number; moving: boolean; sharp: boolean }, done: () => void): void {
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!fence) return;
    gl.flush();
    this.busy = true;
    const poll = () => {
      const spent = performance.now() - picture.start;
      const drawn = gl.isContextLost() || gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED;
      if (!drawn && spent < 4000) {
        setTimeout(poll, 3);
        return;
      }
      gl.deleteSync(fence);
      this.busy = false;
      if (picture.moving && picture.sharp && spent > kMoving_ms) this.slow = true;
      if (picture.moving && !picture.sharp && spent < 8) this.slow = false;
      if (picture.points > 30_000) this.speed = 0.6 * this.speed + 0.4 * (picture.points / Math.max(spent, 1));
      done();
    };
    setTimeout(poll, 3);
  }
}
