// The camera's picture, if the settings name one: again every three seconds while the page is seen.
import {api} from '../api';
import {h, View} from '../dom';
import {live} from '../live';
import type {Preferences} from '../types';
import {t} from '../words';

export class CameraPanel extends View {
  protected show(): void {
    const image = h('img', {class: 'camera', alt: t('camera')});
    let named = false, fails = 0;
    const fetchPicture = () => {
      if (!named || document.hidden || !live.ready) return;
      image.src = `/api/camera?${Date.now()}`;
    };
    image.addEventListener('load', () => {
      fails = 0;
      this.hidden = false;
    });
    image.addEventListener('error', () => {
      if (++fails > 3) named = false;
      this.hidden = true;
    });
    const meet = async () => {
      if (!live.ready) return;
      named = !!(await api.get<Preferences>('/api/preferences').catch(() => ({} as Preferences))).camera;
      fails = 0;
      fetchPicture();
    };
    this.className = 'card';
    this.hidden = true;
    this.append(h('h2', {}, t('camera')), image);
    this.until(live.on('up', () => void meet()));
    this.every(3000, fetchPicture);
    void meet();
  }
}

customElements.define('camera-panel', CameraPanel);
