// Light, dark, or as the device has it.
type Choice = 'auto'|'light'|'dark';

const choices: Choice[] = ['auto', 'light', 'dark'];
const night = matchMedia('(prefers-color-scheme: dark)');

export const theme = {
  get choice(): Choice {
    return choices.find((one) => one === localStorage.getItem('theme')) ?? 'auto';
  },

  begin(): void {
    night.addEventListener('change', () => this.apply());
    this.apply();
  },

  set(choice: Choice): void {
    localStorage.setItem('theme', choice);
    this.apply();
  },

  next(): void {
    this.set(choices[(choices.indexOf(this.choice) + 1) % choices.length]);
  },

  apply(): void {
    const dark = this.choice === 'dark' || (this.choice === 'auto' && night.matches);
    document.documentElement.dataset.theme = dark ? 'dark' : 'light';
    document.dispatchEvent(new Event('theme'));
  },
};
