// Two short tones when a print ends or the printer asks something; off until the person switches it on, as
// browsers require.
let audio: AudioContext|null = null;

export const sound = {
  get on(): boolean {
    return localStorage.getItem('sound') === '1';
  },

  set(on: boolean): void {
    localStorage.setItem('sound', on ? '1' : '0');
    if (on) this.play([660, 880]);
  },

  play(tones: number[]): void {
    if (!this.on) return;
    audio = audio ?? new AudioContext();
    void audio.resume();
    tones.forEach((hertz, n) => this.tone(hertz, n * 0.18));
  },

  tone(hertz: number, delay: number): void {
    if (!audio) return;
    const begin = audio.currentTime + delay, source = audio.createOscillator(), volume = audio.createGain();
    source.frequency.value = hertz;
    volume.gain.setValueAtTime(0, begin);
    volume.gain.linearRampToValueAtTime(0.2, begin + 0.02);
    volume.gain.exponentialRampToValueAtTime(0.001, begin + 0.3);
    source.connect(volume).connect(audio.destination);
    source.start(begin);
    source.stop(begin + 0.32);
  },
};
